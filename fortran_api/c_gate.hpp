/// What the functions of the C interface share: handles, and exceptions turned into status codes.
///
/// A handle is a number that is given out once and never again, dressed as a pointer: a stale handle is
/// looked up, not found and refused; it is never followed. The table only knows which handles live.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cdfp/cdfp.h"
#include "cdfp/cohesive.hpp"
#include "cdfp/contact.hpp"
#include "cdfp/error.hpp"
#include "cdfp/mesh.hpp"
#include "cdfp/model.hpp"
#include "cdfp/recorder.hpp"
#include "cdfp/simulation.hpp"
#include "cdfp/topology.hpp"

namespace cdfp::gate {

/// What a handle stands for, by its type in C.
template <class Handle>
struct Held;
template <>
struct Held<cdfp_mesh> {
  using Object = Mesh;
  static constexpr const char* kName = "mesh";
};
template <>
struct Held<cdfp_model> {
  using Object = Model;
  static constexpr const char* kName = "model";
};
template <>
struct Held<cdfp_simulation> {
  struct Object : Simulation {
    using Simulation::Simulation;
    cdfp_step_callback monitor = nullptr;
    void* user_data = nullptr;
    std::shared_ptr<bool> stepping = std::make_shared<bool>(false);  ///< while the monitor may be called
  };
  static constexpr const char* kName = "simulation";
};
template <>
struct Held<cdfp_recorder> {
  using Object = Recorder;
  static constexpr const char* kName = "recorder";
};
template <>
struct Held<cdfp_topology> {
  struct Object {
    Topology topology;
    Insertion last;
  };
  static constexpr const char* kName = "topology";
};

template <>
struct Held<cdfp_cohesive> {
  struct Object {
    CohesiveElements elements;
    std::vector<CohesiveLaw> laws;
    std::optional<CohesiveCriterion> criterion;
    std::vector<CohesiveCriterion::Opening> open;
    std::vector<Index> facets;  ///< of `open`, as they cross the door
    std::vector<double> tractions;
  };
  static constexpr const char* kName = "cohesive service";
};

/// Compressed rows, as they cross the door.
struct Rows {
  std::vector<Index> start, partners;
};
template <>
struct Held<cdfp_contact_search> {
  struct Object {
    ContactSearch search;
    Index nodes = 0, segments = 0, edges = 0;  ///< of the last search
    Rows node_segments, edge_edges;
  };
  static constexpr const char* kName = "contact search";
};
template <>
struct Held<cdfp_contact> {
  struct Object {
    SurfaceContact contact;
    std::vector<std::string> part_names;
    Rows node_segments, edge_edges;
    std::vector<cdfp_touch> touches;
    std::vector<cdfp_body_pair> pairs;
  };
  static constexpr const char* kName = "contact";
};

// ---- the table of live handles ----

/// An object, and who uses it at the moment.
struct Kept {
  const char* kind;
  std::shared_ptr<void> object;
  int looking = 0;
  bool changing = false;
};

void* keep(const char* kind, std::shared_ptr<void> object);
/// A handle of its own to the same object.
void* share(const void* handle);
/// Does nothing if the handle is not alive (freed before).
void release(const void* handle);
std::int64_t live_handles();

/// Use of the object behind a handle for the length of a call: many may look, one may change.
class Lease {
 public:
  Lease(const void* handle, const char* kind, bool change);
  ~Lease();
  Lease(const Lease&) = delete;
  Lease& operator=(const Lease&) = delete;
  void* object() const { return kept_->object.get(); }

 private:
  std::shared_ptr<Kept> kept_;
  bool change_;
};

template <class Handle>
class Look {
 public:
  explicit Look(const Handle* handle) : lease_(handle, Held<Handle>::kName, false) {}
  const typename Held<Handle>::Object& operator*() const { return *operator->(); }
  const typename Held<Handle>::Object* operator->() const {
    return static_cast<const typename Held<Handle>::Object*>(lease_.object());
  }

 private:
  Lease lease_;
};

template <class Handle>
class Change {
 public:
  explicit Change(Handle* handle) : lease_(handle, Held<Handle>::kName, true) {}
  typename Held<Handle>::Object& operator*() const { return *operator->(); }
  typename Held<Handle>::Object* operator->() const {
    return static_cast<typename Held<Handle>::Object*>(lease_.object());
  }

 private:
  Lease lease_;
};

template <class Handle>
void give(std::shared_ptr<typename Held<Handle>::Object> object, Handle** handle) {
  *handle = static_cast<Handle*>(keep(Held<Handle>::kName, std::move(object)));
}

// ---- errors ----

/// Keeps the text for `cdfp_last_error` and returns the status; never throws. `counted_from_1`: the same
/// where elements and nodes count from 1; null if it names none.
std::int32_t remember(Status status, const char* function, const char* message,
                      const char* counted_from_1 = nullptr) noexcept;
/// The same for the exception that is being handled.
std::int32_t remember_exception(const char* function) noexcept;

template <class Work>
std::int32_t guarded(const char* function, Work&& work) noexcept {
  try {
    work();
    return CDFP_OK;
  } catch (...) {
    return remember_exception(function);
  }
}

template <class Handle>
std::int32_t free_handle(const char* function, Handle** handle) noexcept {
  return guarded(function, [&] {
    if (!handle || !*handle) return;
    release(*handle);
    *handle = nullptr;
  });
}

// ---- arguments ----

[[noreturn]] void refuse(const std::string& message);
void need(const void* argument, const char* name);
/// A count or size as the caller gave it.
std::size_t size_of(std::int64_t count, const char* name);
/// For arrays: may be null only when empty.
void need_array(const void* array, std::int64_t count, const char* name);
/// `number` in [0, count).
void need_number(std::int64_t number, std::int64_t count, const char* what);
/// Names that entries, files and functions are found by: not empty.
std::string name_of(const char* string, const char* argument);
void copy_text(std::string_view from, char* text, std::int64_t capacity, std::int64_t* length);

template <class Value>
void set(Value* out, Value value, const char* name) {
  need(out, name);
  *out = value;
}
/// The caller's vectors at `nodes` nodes.
template <class Value>
std::span<Value> vectors(Value* data, std::int64_t nodes, const char* name) {
  const std::size_t n = size_of(nodes, "nodes");
  need_array(data, nodes, name);
  return {data, 3 * n};
}
/// Refuses types that are not bulk types and a connectivity of another length. `types` may be null.
std::vector<ElementType> element_types_of(std::size_t elements, const std::int32_t* types,
                                          std::size_t corners);
/// The rows that `cdfp_topology_insert_cohesive` gives.
struct Changes {
  Changes(std::int64_t new_node_count, const std::int32_t* new_nodes, std::int64_t renumbered_count,
          const std::int32_t* renumbered);
  std::vector<Insertion::NewNode> new_nodes;
  std::vector<Insertion::Renumbered> renumbered;
};
/// All but the surfaces.
void take_settings(const cdfp_contact_settings* given, ContactSettings& settings);
cdfp_contact_settings shown(const ContactSettings& settings);
CohesiveLaw law_of(const char* name, const cdfp_cohesive_law* law);
void set_callback(CohesiveLaw& law, cdfp_cohesive_callback callback, std::int32_t states, void* user_data);

}  // namespace cdfp::gate
