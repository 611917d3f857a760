/// Wall time by stage of the step.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "core/archive.hpp"

namespace cdfp {

class StageClock {
 public:
  struct Stage {
    std::string name;
    double seconds = 0;
    std::int64_t calls = 0;
  };

  /// Adds a stage and returns its number.
  int add(std::string name) {
    stages_.push_back({std::move(name)});
    return static_cast<int>(stages_.size()) - 1;
  }

  template <class Work>
  void time(int stage, Work&& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    stages_[stage].seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    ++stages_[stage].calls;
  }

  void archive(Archive& a) {
    a.require_same("stages", stages_.size());
    for (Stage& stage : stages_) {
      a("stage.seconds", stage.seconds);
      a("stage.calls", stage.calls);
    }
  }

  const std::vector<Stage>& stages() const { return stages_; }

 private:
  std::vector<Stage> stages_;
};

}  // namespace cdfp
