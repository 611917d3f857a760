!> Explicit finite elements for impact fracture of laminated glass, for Fortran programs.
!>
!> - Define a `cdfp_model`, make a `cdfp_simulation` of it, advance that and look at its state;
!>   `cdfp_recorder` keeps results in a folder. `cdfp_topology` (TopS), `cdfp_cohesive`, `cdfp_contact` and
!>   `cdfp_contact_search` work alone on a program's own arrays.
!> - Every procedure takes an optional `stat` (0: done, or one of CDFP_BAD_ARGUMENT and the like) and
!>   `errmsg`. Without `stat` an error stops the program with the message.
!> - A copy of an object by assignment (`b = a`) is one more owner of the same object: what is done to one is
!>   seen by both, and the object goes with its last owner, when that is freed, made anew or ceases to exist.
!>   Copies that come about otherwise (within an array or a type of yours) name the object without owning it.
!>   `free` may be called twice; an object that has gone is recognised by every call.
!> - Numbers count from 1 in arguments and results; 0 is "none". In messages of errors they count from 0.
!> - Different objects may be used by different threads at once.
module cdfp
  use cdfp_c, only: &
    CDFP_OK, CDFP_BAD_ARGUMENT, CDFP_BAD_INPUT, CDFP_BAD_MESH, CDFP_BAD_STATE, CDFP_DIVERGED, CDFP_IO, &
    CDFP_UNAVAILABLE, CDFP_INTERNAL, CDFP_REGULAR, CDFP_GRADED, CDFP_O_GRID, CDFP_IRREGULAR, CDFP_ONE_POINT, &
    CDFP_FULL, CDFP_HEXAHEDRON, CDFP_TETRAHEDRON, CDFP_WEDGE, CDFP_PYRAMID, CDFP_COHESIVE_QUADRILATERAL, &
    CDFP_COHESIVE_TRIANGLE, CDFP_LINEAR, CDFP_CAMACHO_ORTIZ, CDFP_BILINEAR, CDFP_USER, CDFP_ELEMENT_MEAN, &
    CDFP_NODAL, CDFP_SEARCH_NONE, CDFP_SEARCH_REGULAR, CDFP_SEARCH_ADAPTIVE, cdfp_cohesive_law, &
    cdfp_cohesive_points, cdfp_cohesive_point, cdfp_cohesive_pair, cdfp_touch, cdfp_body_pair, &
    cdfp_nodal_load, cdfp_laminated_plate, cdfp_energies, cdfp_body_state, cdfp_summary, cdfp_contact_pair
  use cdfp_c_material, only: cdfp_material_points
  use cdfp_materials, only: cdfp_material_block, build_material
  use cdfp_meshes, only: cdfp_mesh, default_laminated_plate, assignment(=)
  use cdfp_models, only: cdfp_model, new_cohesive_law, assignment(=)
  use cdfp_simulations, only: cdfp_simulation, cdfp_recorder, assignment(=)
  use cdfp_topologies, only: cdfp_topology, assignment(=)
  use cdfp_cohesives, only: cdfp_cohesive, start_cohesive, cohesive_traction, cohesive_mean_traction, &
    cohesive_stored, assignment(=)
  use cdfp_contacts, only: cdfp_contact_search, cdfp_contact, project_on_face, assignment(=)
  implicit none
  public
end module cdfp
