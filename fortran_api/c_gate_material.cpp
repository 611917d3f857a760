#include <algorithm>
#include <variant>

#include "c_gate.hpp"
#include "cdfp/material_library.hpp"
#include "model/lookup.hpp"

using namespace cdfp;
using namespace cdfp::gate;

namespace {

UserMaterial material_of(const cdfp_user_material* given) {
  need(given, "material");
  UserMaterial material;
  material.density = given->density;
  material.youngs_modulus = given->youngs_modulus;
  material.poissons_ratio = given->poissons_ratio;
  const std::size_t properties = size_of(given->property_count, "property_count");
  need_array(given->properties, given->property_count, "properties");
  material.properties.assign(given->properties, given->properties + properties);
  material.states = given->states;
  material.deletion_state = given->deletion_state;
  material.thread_safe = given->thread_safe != 0;
  return material;
}

}  // namespace

int32_t cdfp_user_material_default(cdfp_user_material* material) {
  return guarded(__func__, [&] {
    need(material, "material");
    const UserMaterial d;
    *material = {.density = d.density,
                 .youngs_modulus = d.youngs_modulus,
                 .poissons_ratio = d.poissons_ratio,
                 .properties = nullptr,
                 .property_count = 0,
                 .states = d.states,
                 .deletion_state = d.deletion_state,
                 .thread_safe = d.thread_safe};
  });
}

int32_t cdfp_model_add_user_material(cdfp_model* model, const char* name, const cdfp_user_material* material,
                                     cdfp_material_callback callback, void* user_data) {
  return guarded(__func__, [&] {
    const Change m(model);
    UserMaterial law = material_of(material);
    if (!callback) refuse("argument 'callback' is null; give the function that computes the stress");
    law.callback = [callback, user_data](const MaterialPoints& points) { callback(&points, user_data); };
    m->materials.push_back({name_of(name, "name"), std::move(law)});
  });
}

int32_t cdfp_model_add_library_material(cdfp_model* model, const char* name,
                                        const cdfp_user_material* material, const char* library,
                                        const char* function) {
  return guarded(__func__, [&] {
    const Change m(model);
    UserMaterial law = material_of(material);
    load_material(name_of(library, "library"), name_of(function, "function"), law);
    m->materials.push_back({name_of(name, "name"), std::move(law)});
  });
}

int32_t cdfp_vumat_default(cdfp_vumat* vumat) {
  return guarded(__func__, [&] {
    need(vumat, "vumat");
    *vumat = {.temperature = VumatOptions{}.temperature,
              .fields = nullptr,
              .field_count = 0,
              .single_precision = 0};
  });
}

int32_t cdfp_model_add_vumat_material(cdfp_model* model, const char* name, const cdfp_user_material* material,
                                      const cdfp_vumat* vumat, const char* library) {
  return guarded(__func__, [&] {
    const Change m(model);
    UserMaterial law = material_of(material);
    need(vumat, "vumat");
    VumatOptions options;
    options.name = name_of(name, "name");
    options.temperature = vumat->temperature;
    const std::size_t fields = size_of(vumat->field_count, "field_count");
    need_array(vumat->fields, vumat->field_count, "fields");
    options.fields.assign(vumat->fields, vumat->fields + fields);
    options.single_precision = vumat->single_precision != 0;
    load_vumat(name_of(library, "library"), options, law);
    m->materials.push_back({options.name, std::move(law)});
  });
}

int32_t cdfp_model_set_state_name(cdfp_model* model, const char* material, int32_t state, const char* name) {
  return guarded(__func__, [&] {
    const Change m(model);
    const std::string wanted = name_of(material, "material");
    const auto found = std::find_if(m->materials.begin(), m->materials.end(),
                                    [&](const Material& known) { return known.name == wanted; });
    auto* law = found == m->materials.end() ? nullptr : std::get_if<UserMaterial>(&found->law);
    if (!law) refuse("there is no user's material '" + wanted + "'; add it first");
    need_number(state, law->states, "state");
    for (auto k = static_cast<std::int32_t>(law->state_names.size()); k <= state; ++k) {
      law->state_names.push_back(state_name(*law, k));
    }
    law->state_names[static_cast<std::size_t>(state)] = name_of(name, "name");
  });
}

int32_t cdfp_build_material(const char* source, const char* library, int32_t single_precision) {
  return guarded(__func__, [&] {
    build_material(name_of(source, "source"), name_of(library, "library"), {single_precision != 0});
  });
}

int32_t cdfp_simulation_element_field(const cdfp_simulation* simulation, const char* name, int64_t elements,
                                      double* values) {
  return guarded(__func__, [&] {
    const Look s(simulation);
    const std::string wanted = name_of(name, "name");
    const std::size_t count = size_of(elements, "elements");
    need_array(values, elements, "values");
    const Frame frame = s->frame();
    if (count != frame.parts.size()) {
      refuse("argument 'elements' is " + std::to_string(count) + "; the simulation has " +
             std::to_string(frame.parts.size()) + " elements");
    }
    const auto give_out = [&](const std::vector<double>& field) {
      std::copy(field.begin(), field.end(), values);
    };
    if (wanted == "von_mises") return give_out(frame.von_mises);
    if (wanted == "max_principal") return give_out(frame.max_principal);
    std::string known = "'von_mises', 'max_principal'";
    for (const ElementField& field : frame.fields) {
      if (field.name == wanted) return give_out(field.values);
      known += ", '" + field.name + "'";
    }
    refuse("there is no field '" + wanted + "'; there are " + known);
  });
}
