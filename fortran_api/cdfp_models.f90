!> What to simulate.
module cdfp_models
  use, intrinsic :: iso_c_binding
  use cdfp_c
  use cdfp_c_material
  use cdfp_handles
  implicit none
  private
  public :: cdfp_model, new_cohesive_law, assignment(=)

  !> Names tie the entries together, in any order; `cdfp_simulation` checks them. All arguments are copied.
  !> Numbers of nodes, elements, facets, parts, layers and axes count from 1. Units are SI.
  type :: cdfp_model
    type(counted_handle) :: handle
  contains
    procedure :: create
    procedure :: free
    procedure :: set_title
    procedure :: set_mesh
    procedure :: set_mixed_mesh
    procedure :: add_node_set
    procedure :: add_facet_set
    procedure :: add_elastic_material
    procedure :: add_rate_dependent_material
    procedure :: add_rigid_material
    procedure :: add_user_material
    procedure :: add_library_material
    procedure :: add_vumat_material
    procedure :: set_state_name
    procedure :: add_cohesive_law
    procedure :: set_cohesive_callback
    procedure :: add_bond
    procedure :: add_bonded_facets
    procedure :: set_stress_recovery
    procedure :: set_strength_shares
    procedure :: add_part
    procedure :: add_rigid_body
    procedure :: add_symmetry_plane
    procedure :: add_prescribed_velocity
    procedure :: add_initial_velocity
    procedure :: set_gravity
    procedure :: set_load_callback
    procedure :: add_contact_surface
    procedure :: set_contact
    procedure :: set_time
    procedure :: set_history_interval
    procedure :: set_threads
  end type

  !> One more owner of the same object.
  interface assignment(=)
    module procedure assign
  end interface

contains

  !> An empty model.
  subroutine create(this, stat, errmsg)
    class(cdfp_model), intent(inout) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: made
    integer(c_int32_t) :: status

    made = c_null_ptr
    status = cdfp_model_create(made)
    call this%handle%own(made)
    call report(status, stat, errmsg)
  end subroutine

  subroutine free(this)
    class(cdfp_model), intent(inout) :: this

    call this%handle%free()
  end subroutine

  subroutine set_title(this, title, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    character(len=*), intent(in) :: title
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call report(cdfp_model_set_title(this%handle%address, c_text(title)), stat, errmsg)
  end subroutine

  !> `coordinates` (3, nodes); `hexahedra` (8, elements): bottom corners, then top; `parts`: part of each
  !> element, by the order of `add_part`; `layers`: through the thickness, from the bottom of the part.
  subroutine set_mesh(this, coordinates, hexahedra, parts, layers, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    real(c_double), contiguous, intent(in) :: coordinates(:, :)
    integer(c_int32_t), contiguous, intent(in) :: hexahedra(:, :)
    integer(c_int32_t), contiguous, intent(in) :: parts(:)
    integer(c_int32_t), contiguous, intent(in), optional :: layers(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t), allocatable :: layers_from_0(:)

    if (size(coordinates, 1) /= 3) then
      call refuse('set_mesh: coordinates must be of shape (3, nodes)', stat, errmsg)
      return
    else if (size(hexahedra, 1) /= 8) then
      call refuse('set_mesh: hexahedra must be of shape (8, elements)', stat, errmsg)
      return
    else if (size(parts) /= size(hexahedra, 2)) then
      call refuse('set_mesh: parts must name one part for each element', stat, errmsg)
      return
    end if
    if (present(layers)) then
      if (size(layers) /= size(hexahedra, 2)) then
        call refuse('set_mesh: layers must name one layer for each element', stat, errmsg)
        return
      end if
      layers_from_0 = layers - 1_c_int32_t
    end if
    ! an array that is not allocated is an absent argument
    call report(cdfp_model_set_mesh(this%handle%address, size(coordinates, 2, c_int64_t), coordinates, &
                                    size(hexahedra, 2, c_int64_t), hexahedra - 1_c_int32_t, &
                                    parts - 1_c_int32_t, layers_from_0), stat, errmsg)
  end subroutine

  !> The same for any bulk elements: `types`: CDFP_TETRAHEDRON and the like; `connectivity`: the corners of all
  !> elements one after the other. A simulation takes hexahedra, tetrahedra and wedges.
  subroutine set_mixed_mesh(this, coordinates, types, connectivity, parts, layers, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    real(c_double), contiguous, intent(in) :: coordinates(:, :)
    integer(c_int32_t), contiguous, intent(in) :: types(:), connectivity(:), parts(:)
    integer(c_int32_t), contiguous, intent(in), optional :: layers(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t), allocatable :: layers_from_0(:)

    if (size(coordinates, 1) /= 3) then
      call refuse('set_mixed_mesh: coordinates must be of shape (3, nodes)', stat, errmsg)
      return
    else if (size(parts) /= size(types)) then
      call refuse('set_mixed_mesh: parts must name one part for each element', stat, errmsg)
      return
    end if
    if (present(layers)) then
      if (size(layers) /= size(types)) then
        call refuse('set_mixed_mesh: layers must name one layer for each element', stat, errmsg)
        return
      end if
      layers_from_0 = layers - 1_c_int32_t
    end if
    call report(cdfp_model_set_mixed_mesh(this%handle%address, size(coordinates, 2, c_int64_t), coordinates, &
                                          size(types, kind=c_int64_t), types, &
                                          size(connectivity, kind=c_int64_t), connectivity - 1_c_int32_t, &
                                          parts - 1_c_int32_t, layers_from_0), stat, errmsg)
  end subroutine

  subroutine add_node_set(this, name, nodes, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    character(len=*), intent(in) :: name
    integer(c_int32_t), contiguous, intent(in) :: nodes(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call report(cdfp_model_add_node_set(this%handle%address, c_text(name), size(nodes, kind=c_int64_t), &
                                        nodes - 1_c_int32_t), stat, errmsg)
  end subroutine

  !> `facets` (2, n): element and its local facet, 1 to 6.
  subroutine add_facet_set(this, name, facets, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    character(len=*), intent(in) :: name
    integer(c_int32_t), contiguous, intent(in) :: facets(:, :)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    if (size(facets, 1) /= 2) then
      call refuse('add_facet_set: facets must be of shape (2, n): element and its facet', stat, errmsg)
      return
    end if
    call report(cdfp_model_add_facet_set(this%handle%address, c_text(name), size(facets, 2, c_int64_t), &
                                         facets - 1_c_int32_t), stat, errmsg)
  end subroutine

  !> Linear elastic with finite rotation.
  subroutine add_elastic_material(this, name, density, youngs_modulus, poissons_ratio, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    character(len=*), intent(in) :: name
    real(c_double), intent(in) :: density, youngs_modulus, poissons_ratio
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call report(cdfp_model_add_elastic_material(this%handle%address, c_text(name), density, youngs_modulus, &
                                                poissons_ratio), stat, errmsg)
  end subroutine

  !> E = static_modulus + rate_modulus * (rate / 1 s^-1)**rate_exponent, rate smoothed over `smoothing_time`.
  subroutine add_rate_dependent_material(this, name, density, poissons_ratio, static_modulus, rate_modulus, &
                                         rate_exponent, smoothing_time, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    character(len=*), intent(in) :: name
    real(c_double), intent(in) :: density, poissons_ratio, static_modulus, rate_modulus, rate_exponent
    real(c_double), intent(in) :: smoothing_time
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call report(cdfp_model_add_rate_dependent_material(this%handle%address, c_text(name), density, &
                                                       poissons_ratio, static_modulus, rate_modulus, &
                                                       rate_exponent, smoothing_time), stat, errmsg)
  end subroutine

  !> Elements that only carry a shape; the elastic constants give the contact stiffness.
  subroutine add_rigid_material(this, name, density, youngs_modulus, poissons_ratio, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    character(len=*), intent(in) :: name
    real(c_double), intent(in) :: density, youngs_modulus, poissons_ratio
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call report(cdfp_model_add_rigid_material(this%handle%address, c_text(name), density, youngs_modulus, &
                                              poissons_ratio), stat, errmsg)
  end subroutine

  !> A material whose law is yours: `callback` is `c_funloc` of a `bind(c)` subroutine with the arguments
  !> `type(cdfp_material_points), intent(in) :: points` and `type(c_ptr), value :: user_data`; within it
  !> `cdfp_material_block` shows the points as arrays. It keeps `states` numbers (0 if absent) at each point; a
  !> point where it makes the state `deletion_state` 0 is deleted. Its first call shows the elastic constants if
  !> they are absent here. Several threads may call it at once if `thread_safe` (false if absent).
  subroutine add_user_material(this, name, density, callback, states, properties, youngs_modulus, poissons_ratio, &
                               deletion_state, thread_safe, user_data, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    character(len=*), intent(in) :: name
    real(c_double), intent(in) :: density
    type(c_funptr), intent(in) :: callback
    integer, intent(in), optional :: states, deletion_state
    real(c_double), target, contiguous, intent(in), optional :: properties(:)
    real(c_double), intent(in), optional :: youngs_modulus, poissons_ratio
    logical, intent(in), optional :: thread_safe
    type(c_ptr), intent(in), optional :: user_data
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(cdfp_user_material) :: material
    type(c_ptr) :: user

    user = c_null_ptr
    if (present(user_data)) user = user_data
    material = filled(density, states, youngs_modulus, poissons_ratio, deletion_state, thread_safe)
    if (present(properties)) call give(material, properties)
    call report(cdfp_model_add_user_material(this%handle%address, c_text(name), material, callback, user), stat, &
                errmsg)
  end subroutine

  !> The same by a function of a shared library.
  subroutine add_library_material(this, name, density, library, function, states, properties, youngs_modulus, &
                                  poissons_ratio, deletion_state, thread_safe, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    character(len=*), intent(in) :: name, library, function
    real(c_double), intent(in) :: density
    integer, intent(in), optional :: states, deletion_state
    real(c_double), target, contiguous, intent(in), optional :: properties(:)
    real(c_double), intent(in), optional :: youngs_modulus, poissons_ratio
    logical, intent(in), optional :: thread_safe
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(cdfp_user_material) :: material

    material = filled(density, states, youngs_modulus, poissons_ratio, deletion_state, thread_safe)
    if (present(properties)) call give(material, properties)
    call report(cdfp_model_add_library_material(this%handle%address, c_text(name), material, c_text(library), &
                                                c_text(function)), stat, errmsg)
  end subroutine

  !> The same by the subroutine VUMAT of a shared library: see `cdfp_build_material`. `temperature` and `fields`
  !> are what it is given (0 and none if absent), `single_precision`: its reals have four bytes.
  subroutine add_vumat_material(this, name, density, library, states, properties, youngs_modulus, poissons_ratio, &
                                deletion_state, thread_safe, temperature, fields, single_precision, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    character(len=*), intent(in) :: name, library
    real(c_double), intent(in) :: density
    integer, intent(in), optional :: states, deletion_state
    real(c_double), target, contiguous, intent(in), optional :: properties(:), fields(:)
    real(c_double), intent(in), optional :: youngs_modulus, poissons_ratio, temperature
    logical, intent(in), optional :: thread_safe, single_precision
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(cdfp_user_material) :: material
    type(cdfp_vumat) :: vumat
    integer(c_int32_t) :: status

    status = cdfp_vumat_default(vumat)
    vumat%temperature = value_or(vumat%temperature, temperature)
    if (present(single_precision)) vumat%single_precision = merge(1_c_int32_t, 0_c_int32_t, single_precision)
    if (present(fields)) then
      vumat%fields = c_loc(fields)
      vumat%field_count = size(fields, kind=c_int64_t)
    end if
    material = filled(density, states, youngs_modulus, poissons_ratio, deletion_state, thread_safe)
    if (present(properties)) call give(material, properties)
    call report(cdfp_model_add_vumat_material(this%handle%address, c_text(name), material, vumat, &
                                              c_text(library)), stat, errmsg)
  end subroutine

  !> Names a state of a user's material in output.
  subroutine set_state_name(this, material, state, name, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    character(len=*), intent(in) :: material, name
    integer, intent(in) :: state
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call report(cdfp_model_set_state_name(this%handle%address, c_text(material), int(state - 1, c_int32_t), &
                                          c_text(name)), stat, errmsg)
  end subroutine

  function filled(density, states, youngs_modulus, poissons_ratio, deletion_state, thread_safe) result(material)
    real(c_double), intent(in) :: density
    integer, intent(in), optional :: states, deletion_state
    real(c_double), intent(in), optional :: youngs_modulus, poissons_ratio
    logical, intent(in), optional :: thread_safe
    type(cdfp_user_material) :: material
    integer(c_int32_t) :: status

    status = cdfp_user_material_default(material)
    material%density = density
    material%youngs_modulus = value_or(material%youngs_modulus, youngs_modulus)
    material%poissons_ratio = value_or(material%poissons_ratio, poissons_ratio)
    if (present(states)) material%states = int(states, c_int32_t)
    if (present(deletion_state)) material%deletion_state = int(deletion_state - 1, c_int32_t)
    if (present(thread_safe)) material%thread_safe = merge(1_c_int32_t, 0_c_int32_t, thread_safe)
  end function

  !> Not in `filled`: an absent array passed on is no absent one to gfortran's sanitizer.
  subroutine give(material, properties)
    type(cdfp_user_material), intent(inout) :: material
    real(c_double), target, contiguous, intent(in) :: properties(:)

    material%properties = c_loc(properties)
    material%property_count = size(properties, kind=c_int64_t)
  end subroutine

  !> Cohesive law: strength (Pa), G_I (J/m2), G_II / G_I (1 if absent), peak shear over strength (1), Coulomb
  !> coefficient between closed faces (0), exponent of its growth with damage (1), share of a pressure that
  !> holds the shear on a facet back (0). `kind`: CDFP_LINEAR (if absent), CDFP_CAMACHO_ORTIZ, CDFP_BILINEAR
  !> (with `stiffness`, Pa/m) or CDFP_USER. With `weibull_modulus` the strength scatters over the facets by
  !> `seed`; `weibull_area` (m2) is what `strength` belongs to. With `rate_sensitivity` c the traction is
  !> multiplied by 1 + c ln(1 + opening rate / `reference_rate` (m/s)).
  subroutine add_cohesive_law(this, name, strength, fracture_energy, mode_ratio, shear_ratio, friction, &
                              friction_exponent, internal_friction, kind, stiffness, weibull_modulus, &
                              weibull_area, seed, rate_sensitivity, reference_rate, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    character(len=*), intent(in) :: name
    real(c_double), intent(in) :: strength, fracture_energy
    real(c_double), intent(in), optional :: mode_ratio, shear_ratio, friction, friction_exponent
    real(c_double), intent(in), optional :: internal_friction, stiffness, weibull_modulus, weibull_area
    real(c_double), intent(in), optional :: rate_sensitivity, reference_rate
    integer(c_int32_t), intent(in), optional :: kind
    integer(c_int64_t), intent(in), optional :: seed
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call report(cdfp_model_add_cohesive_law(this%handle%address, c_text(name), &
                                            new_cohesive_law(strength, fracture_energy, mode_ratio, shear_ratio, &
                                                             friction, friction_exponent, internal_friction, &
                                                             kind, stiffness, weibull_modulus, weibull_area, &
                                                             seed, rate_sensitivity, reference_rate)), stat, errmsg)
  end subroutine

  !> The same as a law for the services: `cdfp_cohesive` and the laws at points.
  function new_cohesive_law(strength, fracture_energy, mode_ratio, shear_ratio, friction, friction_exponent, &
                            internal_friction, kind, stiffness, weibull_modulus, weibull_area, seed, &
                            rate_sensitivity, reference_rate) result(law)
    real(c_double), intent(in) :: strength, fracture_energy
    real(c_double), intent(in), optional :: mode_ratio, shear_ratio, friction, friction_exponent
    real(c_double), intent(in), optional :: internal_friction, stiffness, weibull_modulus, weibull_area
    real(c_double), intent(in), optional :: rate_sensitivity, reference_rate
    integer(c_int32_t), intent(in), optional :: kind
    integer(c_int64_t), intent(in), optional :: seed
    type(cdfp_cohesive_law) :: law
    integer(c_int32_t) :: status

    status = cdfp_cohesive_law_default(law)
    law%strength = strength
    law%fracture_energy = fracture_energy
    law%mode_ratio = value_or(law%mode_ratio, mode_ratio)
    law%shear_ratio = value_or(law%shear_ratio, shear_ratio)
    law%friction = value_or(law%friction, friction)
    law%friction_exponent = value_or(law%friction_exponent, friction_exponent)
    law%internal_friction = value_or(law%internal_friction, internal_friction)
    if (present(kind)) law%kind = kind
    law%stiffness = value_or(law%stiffness, stiffness)
    law%weibull_modulus = value_or(law%weibull_modulus, weibull_modulus)
    law%weibull_area = value_or(law%weibull_area, weibull_area)
    if (present(seed)) law%seed = seed
    law%rate_sensitivity = value_or(law%rate_sensitivity, rate_sensitivity)
    law%reference_rate = value_or(law%reference_rate, reference_rate)
  end function

  !> The traction of a CDFP_USER law: `callback` is `c_funloc` of a `bind(c)` subroutine with the arguments
  !> `type(cdfp_cohesive_points), intent(in) :: points` and `type(c_ptr), value :: user_data`. It keeps `states`
  !> numbers (0 if absent) at each point, and is called once a step.
  subroutine set_cohesive_callback(this, cohesive_law, callback, states, user_data, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    character(len=*), intent(in) :: cohesive_law
    type(c_funptr), intent(in) :: callback
    integer(c_int32_t), intent(in), optional :: states
    type(c_ptr), intent(in), optional :: user_data
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: count
    type(c_ptr) :: user

    count = 0
    if (present(states)) count = states
    user = c_null_ptr
    if (present(user_data)) user = user_data
    call report(cdfp_model_set_cohesive_callback(this%handle%address, c_text(cohesive_law), callback, count, &
                                                 user), stat, errmsg)
  end subroutine

  !> Cohesive elements from the start between all elements of two parts that share nodes, by a CDFP_BILINEAR or
  !> CDFP_USER law.
  subroutine add_bond(this, first_part, second_part, cohesive_law, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    character(len=*), intent(in) :: first_part, second_part, cohesive_law
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call report(cdfp_model_add_bond(this%handle%address, c_text(first_part), c_text(second_part), &
                                    c_text(cohesive_law)), stat, errmsg)
  end subroutine

  !> The same on the facets of a set.
  subroutine add_bonded_facets(this, facet_set, cohesive_law, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    character(len=*), intent(in) :: facet_set, cohesive_law
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call report(cdfp_model_add_bonded_facets(this%handle%address, c_text(facet_set), c_text(cohesive_law)), &
                stat, errmsg)
  end subroutine

  !> How the traction on a facet follows from the stresses of elements: CDFP_ELEMENT_MEAN or CDFP_NODAL.
  subroutine set_stress_recovery(this, recovery, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    integer(c_int32_t), intent(in) :: recovery
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call report(cdfp_model_set_stress_recovery(this%handle%address, recovery), stat, errmsg)
  end subroutine

  !> Share of its law's strength that each element has; a facet has the mean of its two elements.
  subroutine set_strength_shares(this, shares, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    real(c_double), intent(in), contiguous :: shares(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call report(cdfp_model_set_strength_shares(this%handle%address, size(shares, kind=c_int64_t), shares), &
                stat, errmsg)
  end subroutine

  !> The first part added is number 1 of the mesh's `parts`. `formulation`: CDFP_ONE_POINT (if absent) or
  !> CDFP_FULL; `hourglass`: share of the assumed-strain stiffness (1). Without `cohesive_law` it does not
  !> crack.
  subroutine add_part(this, name, material, formulation, hourglass, cohesive_law, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    character(len=*), intent(in) :: name, material
    integer(c_int32_t), intent(in), optional :: formulation
    real(c_double), intent(in), optional :: hourglass
    character(len=*), intent(in), optional :: cohesive_law
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: kind
    character(kind=c_char, len=:), allocatable :: law

    kind = CDFP_ONE_POINT
    if (present(formulation)) kind = formulation
    law = c_text('')
    if (present(cohesive_law)) law = c_text(cohesive_law)
    call report(cdfp_model_add_part(this%handle%address, c_text(name), c_text(material), kind, &
                                    value_or(1.0_c_double, hourglass), law), stat, errmsg)
  end subroutine

  !> All elements of a part move as one. `mass` of what is modelled; `inertia` about the centre of mass (from
  !> the mesh if absent); velocities are zero and directions free if absent.
  subroutine add_rigid_body(this, part, mass, inertia, velocity, angular_velocity, translation_fixed, &
                            rotation_fixed, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    character(len=*), intent(in) :: part
    real(c_double), intent(in) :: mass
    real(c_double), intent(in), optional :: inertia(3, 3), velocity(3), angular_velocity(3)
    logical, intent(in), optional :: translation_fixed(3), rotation_fixed(3)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call report(cdfp_model_add_rigid_body(this%handle%address, c_text(part), mass, inertia, velocity, &
                                          angular_velocity, flags(translation_fixed), &
                                          flags(rotation_fixed)), stat, errmsg)
  end subroutine

  !> Mirror plane normal to an axis: 1, 2 or 3.
  subroutine add_symmetry_plane(this, axis, coordinate, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    integer, intent(in) :: axis
    real(c_double), intent(in) :: coordinate
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call report(cdfp_model_add_symmetry_plane(this%handle%address, int(axis, c_int32_t) - 1_c_int32_t, &
                                              coordinate), stat, errmsg)
  end subroutine

  !> One value for each time, linear between them; without `times` one value, for good.
  subroutine add_prescribed_velocity(this, node_set, directions, values, times, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    character(len=*), intent(in) :: node_set
    logical, intent(in) :: directions(3)
    real(c_double), contiguous, intent(in) :: values(:)
    real(c_double), contiguous, intent(in), optional :: times(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    real(c_double), allocatable :: instants(:)

    if (present(times)) then
      if (size(times) /= size(values)) then
        call refuse('add_prescribed_velocity: there must be one value for each time', stat, errmsg)
        return
      end if
      allocate (instants, source=times)
    end if
    ! an array that is not allocated is an absent argument
    call report(cdfp_model_add_prescribed_velocity(this%handle%address, c_text(node_set), flags(directions), &
                                                   size(values, kind=c_int64_t), instants, values), stat, errmsg)
  end subroutine

  !> Of a deformable part: velocity + matmul(gradient, position); no gradient if absent.
  subroutine add_initial_velocity(this, part, velocity, gradient, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    character(len=*), intent(in) :: part
    real(c_double), intent(in) :: velocity(3)
    real(c_double), intent(in), optional :: gradient(3, 3)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    if (present(gradient)) then
      call report(cdfp_model_add_initial_velocity(this%handle%address, c_text(part), velocity, &
                                                  reshape(transpose(gradient), [9])), stat, errmsg)
    else
      call report(cdfp_model_add_initial_velocity(this%handle%address, c_text(part), velocity), stat, errmsg)
    end if
  end subroutine

  subroutine set_gravity(this, gravity, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    real(c_double), intent(in) :: gravity(3)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call report(cdfp_model_set_gravity(this%handle%address, gravity), stat, errmsg)
  end subroutine

  !> Forces of the program's own: `callback` is `c_funloc` of a `bind(c)` subroutine with the arguments
  !> `type(cdfp_nodal_load), intent(in) :: load` and `type(c_ptr), value :: user_data`. It is called once a step
  !> and adds to `load%force`, which holds the forces of elements and gravity. Its work is external work.
  subroutine set_load_callback(this, callback, user_data, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    type(c_funptr), intent(in) :: callback
    type(c_ptr), intent(in), optional :: user_data
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: user

    user = c_null_ptr
    if (present(user_data)) user = user_data
    call report(cdfp_model_set_load_callback(this%handle%address, callback, user), stat, errmsg)
  end subroutine

  !> A facet set that may touch others and itself; without any the scene has no contact.
  subroutine add_contact_surface(this, facet_set, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    character(len=*), intent(in) :: facet_set
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call report(cdfp_model_add_contact_surface(this%handle%address, c_text(facet_set)), stat, errmsg)
  end subroutine

  !> What is absent stays as it is: see `cdfp_contact_settings` in cdfp/c/model.h.
  subroutine set_contact(this, cell_factor, buffer_factor, penalty_factor, friction, depth_limit, edge_edge, &
                         adaptive, penetration_warning, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    real(c_double), intent(in), optional :: cell_factor, buffer_factor, penalty_factor, friction, depth_limit
    real(c_double), intent(in), optional :: penetration_warning
    logical, intent(in), optional :: edge_edge, adaptive
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(cdfp_contact_settings) :: settings
    integer(c_int32_t) :: status

    status = cdfp_model_get_contact(this%handle%address, settings)
    if (status == CDFP_OK) then
      settings%cell_factor = value_or(settings%cell_factor, cell_factor)
      settings%buffer_factor = value_or(settings%buffer_factor, buffer_factor)
      settings%penalty_factor = value_or(settings%penalty_factor, penalty_factor)
      settings%friction = value_or(settings%friction, friction)
      settings%depth_limit = value_or(settings%depth_limit, depth_limit)
      settings%penetration_warning = value_or(settings%penetration_warning, penetration_warning)
      if (present(edge_edge)) settings%edge_edge = merge(1_c_int32_t, 0_c_int32_t, edge_edge)
      if (present(adaptive)) settings%adaptive = merge(1_c_int32_t, 0_c_int32_t, adaptive)
      status = cdfp_model_set_contact(this%handle%address, settings)
    end if
    call report(status, stat, errmsg)
  end subroutine

  !> `fixed_step` 0: automatic, `step_factor` of the stable step. What is absent stays as it is.
  subroutine set_time(this, end, fixed_step, step_factor, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    real(c_double), intent(in), optional :: end, fixed_step, step_factor
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status

    status = CDFP_OK
    if (present(end)) status = cdfp_model_set_end_time(this%handle%address, end)
    if (present(fixed_step) .and. status == CDFP_OK) &
      status = cdfp_model_set_fixed_step(this%handle%address, fixed_step)
    if (present(step_factor) .and. status == CDFP_OK) &
      status = cdfp_model_set_step_factor(this%handle%address, step_factor)
    call report(status, stat, errmsg)
  end subroutine

  !> Steps between rows of the history.
  subroutine set_history_interval(this, steps, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    integer, intent(in) :: steps
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call report(cdfp_model_set_history_interval(this%handle%address, int(steps, c_int64_t)), stat, errmsg)
  end subroutine

  !> 0: as many as the machine has. Results are the same bits for any number.
  subroutine set_threads(this, threads, stat, errmsg)
    class(cdfp_model), intent(in) :: this
    integer, intent(in) :: threads
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call report(cdfp_model_set_threads(this%handle%address, int(threads, c_int32_t)), stat, errmsg)
  end subroutine

  pure function value_or(default, value) result(chosen)
    real(c_double), intent(in) :: default
    real(c_double), intent(in), optional :: value
    real(c_double) :: chosen

    chosen = default
    if (present(value)) chosen = value
  end function

  pure function flags(given) result(values)
    logical, intent(in), optional :: given(3)
    integer(c_int32_t) :: values(3)

    values = 0
    if (present(given)) values = merge(1_c_int32_t, 0_c_int32_t, given)
  end function

  subroutine assign(this, other)
    type(cdfp_model), intent(inout) :: this
    type(cdfp_model), intent(in) :: other

    call this%handle%share(other%handle)
  end subroutine

end module cdfp_models
