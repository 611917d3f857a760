/// Names of a model resolved.
#pragma once

#include <string>
#include <vector>

#include "cdfp/model.hpp"

namespace cdfp {

// Each throws `Error(bad_argument)` with the names that there are if the name is unknown.
Index part_number(const Mesh& mesh, const std::string& name);
const NodeSet& node_set(const Mesh& mesh, const std::string& name);
const FacetSet& facet_set(const Mesh& mesh, const std::string& name);
const Material& material(const Model& model, const std::string& name);
const CohesiveLaw& cohesive_law(const Model& model, const std::string& name);

/// The entry of `model.parts` for each part of the mesh. Throws if one is missing, unknown or given twice.
std::vector<const Part*> parts_in_order(const Model& model);

/// What output calls a state (from 0) of a user's material.
std::string state_name(const UserMaterial& law, int state);

bool is_rigid(const Model& model, const Part& part);

/// Where each element's corners start in `mesh.connectivity`.
std::vector<Index> first_corners(const Mesh& mesh);

}  // namespace cdfp
