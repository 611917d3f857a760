#include <cdfp/cdfp.h>
#include <stdio.h>

int main(void) {
  cdfp_mesh* mesh = NULL;
  cdfp_laminated_plate plate;
  cdfp_laminated_plate_default(&plate);
  plate.columns = 4;
  const int32_t* hexahedra = NULL;
  int64_t elements = 0;
  if (cdfp_mesh_create_laminated_plate(&plate, &mesh) != CDFP_OK ||
      cdfp_mesh_hexahedra(mesh, &hexahedra, &elements) != CDFP_OK || elements < 160) {
    return 1;
  }
  cdfp_mesh_free(&mesh);
  printf("%ld elements from C\n", (long)elements);
  return 0;
}
