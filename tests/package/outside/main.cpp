#include <cdfp/laminated_plate.hpp>
#include <cdfp/topology.hpp>
#include <cstdio>

int main() {
  cdfp::LaminatedPlate plate;
  plate.columns = 4;
  plate.layout = cdfp::PlateColumns::regular;
  const cdfp::Mesh mesh = cdfp::laminated_plate_mesh(plate);
  const cdfp::Topology topology(mesh.node_count(), mesh.types, mesh.connectivity);
  std::printf("%d elements from C++\n", mesh.element_count());
  return topology.bulk_count() == mesh.element_count() && mesh.element_count() >= 160 ? 0 : 1;
}
