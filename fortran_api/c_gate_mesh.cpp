#include <algorithm>

#include "c_gate.hpp"
#include "cdfp/laminated_plate.hpp"

using namespace cdfp;
using namespace cdfp::gate;

static_assert(sizeof(FacetUse) == 2 * sizeof(int32_t), "facet sets cross the door as pairs");
static_assert(sizeof(Index) == sizeof(int32_t));
static_assert(int32_t(PlateColumns::regular) == CDFP_REGULAR &&
              int32_t(PlateColumns::graded) == CDFP_GRADED && int32_t(PlateColumns::o_grid) == CDFP_O_GRID &&
              int32_t(PlateColumns::irregular) == CDFP_IRREGULAR);

namespace {

template <class Value>
void show(const std::vector<Value>& values, std::size_t per_entry, const Value** data, int64_t* count,
          const char* data_name, const char* count_name) {
  need(data, data_name);
  need(count, count_name);
  *data = values.data();
  *count = static_cast<int64_t>(values.size() / per_entry);
}

/// The set of that name; throws with the names that there are.
template <class Set>
const Set& named(const std::vector<Set>& sets, const char* name, const char* kind) {
  need(name, "name");
  std::string known;
  for (const Set& set : sets) {
    if (set.name == name) return set;
    known += (known.empty() ? "'" : ", '") + set.name + "'";
  }
  refuse("there is no " + std::string(kind) + " '" + name + "'; there are " +
         (known.empty() ? "none" : known));
}

}  // namespace

int32_t cdfp_laminated_plate_default(cdfp_laminated_plate* plate) {
  return guarded(__func__, [&] {
    need(plate, "plate");
    const LaminatedPlate d;
    *plate = {.half_width = d.half_width,
              .lower_glass = d.lower_glass,
              .pvb = d.pvb,
              .upper_glass = d.upper_glass,
              .support = d.support,
              .lower_layers = d.lower_layers,
              .pvb_layers = d.pvb_layers,
              .upper_layers = d.upper_layers,
              .support_layers = d.support_layers,
              .columns = d.columns,
              .layout = static_cast<int32_t>(d.layout),
              .impactor_radius = d.impactor_radius,
              .impactor_shaft = d.impactor_shaft,
              .impactor_gap = d.impactor_gap,
              .impactor_refinement = d.impactor_refinement};
  });
}

int32_t cdfp_mesh_create_laminated_plate(const cdfp_laminated_plate* plate, cdfp_mesh** mesh) {
  return guarded(__func__, [&] {
    need(plate, "plate");
    need(mesh, "mesh");
    if (plate->layout < CDFP_REGULAR || plate->layout > CDFP_IRREGULAR) {
      refuse("layout is " + std::to_string(plate->layout) +
             "; take CDFP_REGULAR, CDFP_GRADED, CDFP_O_GRID or CDFP_IRREGULAR");
    }
    LaminatedPlate p;
    p.half_width = plate->half_width;
    p.lower_glass = plate->lower_glass;
    p.pvb = plate->pvb;
    p.upper_glass = plate->upper_glass;
    p.support = plate->support;
    p.lower_layers = plate->lower_layers;
    p.pvb_layers = plate->pvb_layers;
    p.upper_layers = plate->upper_layers;
    p.support_layers = plate->support_layers;
    p.columns = plate->columns;
    p.layout = static_cast<PlateColumns>(plate->layout);
    p.impactor_radius = plate->impactor_radius;
    p.impactor_shaft = plate->impactor_shaft;
    p.impactor_gap = plate->impactor_gap;
    p.impactor_refinement = plate->impactor_refinement;
    give(std::make_shared<Mesh>(laminated_plate_mesh(p)), mesh);
  });
}

int32_t cdfp_mesh_free(cdfp_mesh** mesh) {
  return free_handle(__func__, mesh);
}

int32_t cdfp_mesh_coordinates(const cdfp_mesh* mesh, const double** coordinates, int64_t* nodes) {
  return guarded(__func__,
                 [&] { show(Look(mesh)->coordinates, 3, coordinates, nodes, "coordinates", "nodes"); });
}

int32_t cdfp_mesh_hexahedra(const cdfp_mesh* mesh, const int32_t** hexahedra, int64_t* elements) {
  return guarded(__func__,
                 [&] { show(Look(mesh)->connectivity, 8, hexahedra, elements, "hexahedra", "elements"); });
}

int32_t cdfp_mesh_parts(const cdfp_mesh* mesh, const int32_t** parts, int64_t* elements) {
  return guarded(__func__, [&] { show(Look(mesh)->parts, 1, parts, elements, "parts", "elements"); });
}

int32_t cdfp_mesh_layers(const cdfp_mesh* mesh, const int32_t** layers, int64_t* elements) {
  return guarded(__func__, [&] { show(Look(mesh)->layers, 1, layers, elements, "layers", "elements"); });
}

int32_t cdfp_mesh_part_count(const cdfp_mesh* mesh, int64_t* count) {
  return guarded(__func__, [&] {
    const Look m(mesh);
    need(count, "count");
    *count = static_cast<int64_t>(m->part_names.size());
  });
}

int32_t cdfp_mesh_part_name(const cdfp_mesh* mesh, int64_t part, char* text, int64_t capacity,
                            int64_t* length) {
  return guarded(__func__, [&] {
    const Look m(mesh);
    need_number(part, static_cast<int64_t>(m->part_names.size()), "part");
    copy_text(m->part_names[part], text, capacity, length);
  });
}

int32_t cdfp_mesh_node_set(const cdfp_mesh* mesh, const char* name, const int32_t** nodes, int64_t* count) {
  return guarded(__func__, [&] {
    show(named(Look(mesh)->node_sets, name, "node set").nodes, 1, nodes, count, "nodes", "count");
  });
}

int32_t cdfp_mesh_facet_set(const cdfp_mesh* mesh, const char* name, const int32_t** facets, int64_t* count) {
  return guarded(__func__, [&] {
    const Look m(mesh);
    const std::vector<FacetUse>& uses = named(m->facet_sets, name, "facet set").facets;
    need(facets, "facets");
    need(count, "count");
    *facets = uses.empty() ? nullptr : &uses.front().element;
    *count = static_cast<int64_t>(uses.size());
  });
}
