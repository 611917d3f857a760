#include "speed/impact_case.hpp"

#include "cdfp/laminated_plate.hpp"
#include "driver/case_reader.hpp"

namespace speed {

using namespace cdfp;

Model impact_case(Index columns) {
  Model model = read_case("examples/laminated_glass/case.toml");
  if (columns != 67) {
    LaminatedPlate plate;
    plate.columns = columns;
    plate.layout = PlateColumns::regular;
    model.mesh = laminated_plate_mesh(plate);
    model.time.fixed_step = 0;
  }
  return model;
}

}  // namespace speed
