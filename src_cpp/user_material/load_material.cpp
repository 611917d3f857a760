#include "cdfp/error.hpp"
#include "cdfp/material_library.hpp"
#include "user_material/shared_library.hpp"

namespace cdfp {

void load_material(const std::string& library, const std::string& symbol, UserMaterial& material) {
  const SharedLibrary loaded(library);
  const auto law = reinterpret_cast<cdfp_material_callback>(loaded.find({symbol, symbol + "_"}));
  if (!law) {
    throw Error(Status::io, "library '" + library + "' has no function '" + symbol +
                                "'; name the one that takes cdfp_material_points, and give it C linkage "
                                "(extern \"C\", bind(c))");
  }
  material.callback = [loaded, law](const MaterialPoints& points) { law(&points, nullptr); };
}

}  // namespace cdfp
