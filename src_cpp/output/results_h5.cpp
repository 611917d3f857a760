#include "output/results_h5.hpp"

#include <hdf5.h>

#include <algorithm>
#include <mutex>
#include <span>
#include <utility>

#include "output/columns.hpp"
#include "output/files.hpp"

namespace cdfp {
namespace {

/// A handle of HDF5 that closes itself; the constructor refuses what failed.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close) : id_(id), close_(close) { check(id); }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle& operator=(Handle&&) = delete;
  operator hid_t() const { return id_; }

  static void check(long long status) {
    if (status < 0)
      throw Error(Status::io,
                  "HDF5 could not write results.h5; give an output folder on a disk that has room");
  }

 private:
  hid_t id_;
  Close close_;
};

Handle text_type() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  Handle::check(H5Tset_size(type, H5T_VARIABLE));
  Handle::check(H5Tset_cset(type, H5T_CSET_UTF8));
  return type;
}

void attribute(hid_t object, const char* name, const std::string& text) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle type = text_type();
  const Handle id(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const char* value = text.c_str();
  Handle::check(H5Awrite(id, type, &value));
}

template <class Number>
void attribute(hid_t object, const char* name, hid_t type, Number value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle id(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  Handle::check(H5Awrite(id, type, &value));
}

struct About {
  const char* name;
  const char* units;
  const char* description;
};

/// Rows of `width` numbers; chunked and deflated unless empty.
void dataset(hid_t group, const About& about, hid_t type, const void* values, hsize_t rows,
             hsize_t width = 1) {
  const hsize_t extent[2] = {rows, width};
  const int rank = width > 1 ? 2 : 1;
  const Handle space(H5Screate_simple(rank, extent, nullptr), H5Sclose);
  const Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  if (rows > 0) {
    const hsize_t chunk[2] = {std::min<hsize_t>(rows, 16384), width};
    Handle::check(H5Pset_chunk(layout, rank, chunk));
    Handle::check(H5Pset_shuffle(layout));
    Handle::check(H5Pset_deflate(layout, 4));
  }
  const Handle id(H5Dcreate2(group, about.name, type, space, H5P_DEFAULT, layout, H5P_DEFAULT), H5Dclose);
  if (rows > 0) Handle::check(H5Dwrite(id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
  attribute(id, "units", about.units);
  attribute(id, "description", about.description);
}

void dataset(hid_t group, const About& about, std::span<const double> values, hsize_t width = 1) {
  dataset(group, about, H5T_NATIVE_DOUBLE, values.data(), values.size() / width, width);
}

void dataset(hid_t group, const About& about, std::span<const Index> values, hsize_t width = 1) {
  dataset(group, about, H5T_NATIVE_INT32, values.data(), values.size() / width, width);
}

Handle group(hid_t parent, const char* name) {
  return Handle(H5Gcreate2(parent, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
}

void write_history(hid_t file, const History& history) {
  const Handle rows = group(file, "history");
  attribute(rows, "description", "one dataset a column, one entry every few steps");
  std::vector<double> values;
  for (const std::string& name : history.columns) {
    values = column(history, name);
    dataset(rows, {name.c_str(), column_units(name), "history of the run"}, values);
  }
}

void write_names(hid_t parent, const std::vector<std::string>& names) {
  std::vector<const char*> texts;
  texts.reserve(names.size());
  for (const std::string& name : names) texts.push_back(name.c_str());
  const Handle type = text_type();
  const hsize_t extent = texts.size();
  const Handle space(H5Screate_simple(1, &extent, nullptr), H5Sclose);
  const Handle id(H5Dcreate2(parent, "part_names", type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                  H5Dclose);
  if (extent > 0) Handle::check(H5Dwrite(id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.data()));
  attribute(id, "units", "1");
  attribute(id, "description", "names of the parts, in the order of their numbers");
}

void write_cracks(hid_t parent, const std::vector<CrackFacet>& cracks) {
  std::vector<Index> upper, lower, part, layer;
  std::vector<double> damage, insertion_time, broken_time;
  for (const CrackFacet& facet : cracks) {
    upper.insert(upper.end(), facet.upper.begin(), facet.upper.end());
    lower.insert(lower.end(), facet.lower.begin(), facet.lower.end());
    part.push_back(facet.part);
    layer.push_back(facet.layer);
    damage.push_back(facet.damage);
    insertion_time.push_back(facet.insertion_time);
    broken_time.push_back(facet.broken_time);
  }
  const Handle facets = group(parent, "cracks");
  attribute(facets, "description", "cohesive elements, one entry each");
  dataset(facets, {"upper", "1", "nodes of the upper face, from 0"}, upper, 4);
  dataset(facets, {"lower", "1", "nodes of the lower face, from 0"}, lower, 4);
  dataset(facets, {"part", "1", "part that the facet splits, from 0"}, part);
  dataset(facets, {"layer", "1", "layer from the bottom of the part, from 0"}, layer);
  dataset(facets, {"damage", "1", "0 just inserted, 1 broken"}, damage);
  dataset(facets, {"insertion_time", "s", "time of insertion"}, insertion_time);
  dataset(facets, {"broken_time", "s", "time at which the traction was gone; inf while unbroken"},
          broken_time);
}

void write_state(hid_t file, const Frame& frame) {
  const Handle state = group(file, "final");
  attribute(state, "description", "the last state that was written");
  attribute(state, "time_s", H5T_NATIVE_DOUBLE, frame.time);
  attribute(state, "step", H5T_NATIVE_INT64, frame.step);
  dataset(state, {"positions", "m", "nodes as they are now"}, frame.positions, 3);
  dataset(state, {"velocities", "m/s", "nodal velocities"}, frame.velocities, 3);
  dataset(state, {"connectivity", "1", "corners of all elements in VTK's order, from 0"}, frame.connectivity);
  dataset(state, {"first_corner", "1", "of each element in the connectivity, and its end"},
          frame.first_corner);
  dataset(state, {"parts", "1", "part of each element, from 0"}, frame.parts);
  dataset(state, {"von_mises", "Pa", "equivalent stress of each element"}, frame.von_mises);
  dataset(state, {"max_principal", "Pa", "largest principal stress of each element"}, frame.max_principal);
  if (!frame.fields.empty()) {
    const Handle fields = group(state, "fields");
    attribute(fields, "description", "states of users' materials by name and stress, one entry an element");
    for (const ElementField& field : frame.fields) {
      const bool stress = field.name.starts_with("stress_");
      dataset(fields, {field.name.c_str(), stress ? "Pa" : "of the law", "mean over the element's points"},
              field.values);
    }
  }
  write_names(state, frame.part_names);
  write_cracks(state, frame.cracks);
}

}  // namespace

void write_results_h5(const std::filesystem::path& path, const Frame& frame, const History& history) {
  // Debian's serial HDF5 keeps global state that is not safe for threads.
  static std::mutex one_at_a_time;
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const std::filesystem::path temporary = temporary_beside(path);
  {
    const Handle file(H5Fcreate(temporary.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
    attribute(file, "description", "cdfp: histories and last state of an impact fracture run, SI units");
    attribute(file, "layout_version", H5T_NATIVE_INT32, std::int32_t{1});
    write_history(file, history);
    write_state(file, frame);
    Handle::check(H5Fflush(file, H5F_SCOPE_LOCAL));
  }
  move_into_place(temporary, path);
}

}  // namespace cdfp
