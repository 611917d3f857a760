#include "output/restart_file.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>

#include "core/archive.hpp"
#include "core/digest.hpp"
#include "output/files.hpp"

namespace cdfp {

namespace {

constexpr std::array<char, 16> kMagic{"cdfp restart\n\x1a\n"};
/// To be raised whenever what is saved changes.
constexpr std::uint32_t kVersion = 2;

struct Head {
  std::array<char, 16> magic = kMagic;
  std::uint32_t version = kVersion;
  std::uint32_t byte_order = 0x01020304;
  std::uint64_t size = 0;    ///< of what follows
  std::uint64_t digest = 0;  ///< of what follows
};

std::uint64_t digest_of(std::string_view bytes) {
  Digest digest;
  digest.add(bytes);
  return digest.value();
}

[[noreturn]] void refuse_file(const std::filesystem::path& path, const std::string& why) {
  throw Error(Status::bad_input, "cannot continue from '" + path.string() + "': " + why);
}

}  // namespace

void write_restart(const std::filesystem::path& path, const Fingerprint& fingerprint,
                   const std::string& state) {
  Archive model;
  std::uint64_t count = fingerprint.size();
  model("model", count);
  for (auto [name, digest] : fingerprint) {
    model("name", name);
    model("digest", digest);
  }
  Digest digest;
  digest.add(digest_of(model.bytes()));
  digest.add(digest_of(state));
  const std::uint64_t model_size = model.bytes().size();
  Head head;
  head.size = sizeof model_size + model_size + state.size();
  head.digest = digest.value();
  const auto text = [](const auto& value) {
    return std::string_view(reinterpret_cast<const char*>(&value), sizeof value);
  };
  const std::array<std::string_view, 4> pieces{text(head), text(model_size), model.bytes(), state};
  write_whole_file(path, pieces);
}

std::string read_restart(const std::filesystem::path& path, const Fingerprint& fingerprint) {
  errno = 0;
  const std::string bytes = contents_of(path);
  if (bytes.empty()) {
    throw Error(Status::io, "cannot read the restart file '" + path.string() +
                                "': " + (errno != 0 ? std::strerror(errno) : "it is empty") +
                                "; give a file that a run has saved");
  }
  Head head;
  if (bytes.size() < sizeof head || std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) != 0) {
    refuse_file(path, "it is no restart file; give one that a run has saved");
  }
  std::memcpy(&head, bytes.data(), sizeof head);
  if (head.version != kVersion || head.byte_order != Head{}.byte_order) {
    refuse_file(path, "another version of cdfp has written it (format " + std::to_string(head.version) +
                          ", this one reads " + std::to_string(kVersion) +
                          "); continue with that one or start anew");
  }
  std::uint64_t model_size = 0;
  if (bytes.size() - sizeof head != head.size || head.size < sizeof model_size) {
    refuse_file(path, "it has " + std::to_string(bytes.size()) + " bytes of " +
                          std::to_string(head.size + sizeof head) +
                          ": a copy that was cut short; copy it again or take another");
  }
  std::memcpy(&model_size, bytes.data() + sizeof head, sizeof model_size);
  const std::size_t model_at = sizeof head + sizeof model_size;
  const bool fits = model_size <= bytes.size() - model_at;
  const std::string_view all(bytes);
  Digest digest;
  if (fits) {
    digest.add(digest_of(all.substr(model_at, model_size)));
    digest.add(digest_of(all.substr(model_at + model_size)));
  }
  if (!fits || digest.value() != head.digest) {
    refuse_file(path, "its contents are damaged; copy it again or take another");
  }

  Archive model(bytes.substr(model_at, model_size));
  model.require_same("model", fingerprint.size());
  for (const auto& [name, value] : fingerprint) {
    std::string saved_name;
    std::uint64_t saved = 0;
    model("name", saved_name);
    model("digest", saved);
    if (saved_name == name && saved == value) continue;
    refuse_file(path, "it was saved by another model, whose " + name +
                          " is not as in this one; continue with the model that has saved it (only title, "
                          "threads, time and output may change)");
  }
  return bytes.substr(model_at + model_size);
}

}  // namespace cdfp
