#include "model/lookup.hpp"

#include <variant>

#include "cdfp/error.hpp"
#include "topology/templates.hpp"

namespace cdfp {

namespace {

template <class Items, class NameOf>
std::size_t find(const Items& items, const std::string& name, const char* kind, NameOf&& name_of) {
  std::string known;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (name_of(items[i]) == name) return i;
    known += (i ? ", " : "") + ("'" + name_of(items[i]) + "'");
  }
  throw Error(Status::bad_argument, std::string("there is no ") + kind + " '" + name + "'; " +
                                        (known.empty() ? "none is defined" : "there are " + known));
}

constexpr auto name_field = [](const auto& item) { return item.name; };

}  // namespace

Index part_number(const Mesh& mesh, const std::string& name) {
  return static_cast<Index>(find(mesh.part_names, name, "part", [](const std::string& s) { return s; }));
}

const NodeSet& node_set(const Mesh& mesh, const std::string& name) {
  return mesh.node_sets[find(mesh.node_sets, name, "node set", name_field)];
}

const FacetSet& facet_set(const Mesh& mesh, const std::string& name) {
  return mesh.facet_sets[find(mesh.facet_sets, name, "facet set", name_field)];
}

const Material& material(const Model& model, const std::string& name) {
  return model.materials[find(model.materials, name, "material", name_field)];
}

const CohesiveLaw& cohesive_law(const Model& model, const std::string& name) {
  return model.cohesive_laws[find(model.cohesive_laws, name, "cohesive law", name_field)];
}

std::vector<const Part*> parts_in_order(const Model& model) {
  std::vector<const Part*> parts(model.mesh.part_names.size(), nullptr);
  for (const Part& part : model.parts) {
    const Part*& slot = parts[part_number(model.mesh, part.name)];
    if (slot)
      throw Error(Status::bad_argument, "part '" + part.name + "' is defined twice; keep one definition");
    slot = &part;
  }
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (!parts[p]) {
      throw Error(Status::bad_argument,
                  "part '" + model.mesh.part_names[p] +
                      "' of the mesh has no definition; give it a material and a formulation");
    }
  }
  return parts;
}

std::string state_name(const UserMaterial& law, int state) {
  const auto at = static_cast<std::size_t>(state);
  return at < law.state_names.size() ? law.state_names[at] : "state_" + std::to_string(state + 1);
}

bool is_rigid(const Model& model, const Part& part) {
  return std::holds_alternative<RigidMaterial>(material(model, part.material).law);
}

std::vector<Index> first_corners(const Mesh& mesh) {
  std::vector<Index> first(mesh.types.size() + 1, 0);
  for (std::size_t e = 0; e < mesh.types.size(); ++e) {
    first[e + 1] = first[e] + element_template(mesh.types[e]).corner_count;
  }
  return first;
}

}  // namespace cdfp
