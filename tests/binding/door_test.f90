!> The module `cdfp` on two cubes: copies of handles, wrong calls, numbers that count from 1, views in place.
program door_test
  use, intrinsic :: iso_c_binding, only: c_int64_t
  use, intrinsic :: iso_fortran_env, only: dp => real64, int32, int64, error_unit
  use cdfp
  implicit none

  interface
    function live_handles() bind(c) result(count)
      import :: c_int64_t
      integer(c_int64_t) :: count
    end function
  end interface

  type :: holder
    type(cdfp_model) :: model
  end type

  real(dp), parameter :: coordinates(3, 12) = reshape([real(dp) :: &
    0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1, 0, 0, 2, 1, 0, 2, 1, 1, 2, 0, 1, &
    2], &
    [3, 12])
  integer(int32), parameter :: hexahedra(8, 2) = reshape([integer(int32) :: &
    1, 2, 3, 4, 5, 6, 7, 8, 5, 6, 7, 8, 9, 10, 11, 12], [8, 2])
  integer(int32), parameter :: parts(2) = 1_int32, layers(2) = [1_int32, 2_int32]
  integer :: failures = 0, stat
  character(len=300) :: message

  call copies_own()
  call check(live_handles() == 0, 'every object went with its last owner')
  call copies_by_the_compiler()
  call check(live_handles() == 0, 'copies by the compiler leave nothing')
  call wrong_calls()
  call topology()
  call simulation()
  call plate()
  call cohesive_service()
  call contact_service()
  call state_between_steps()
  call check(live_handles() == 0, 'nothing is left at the end')
  if (failures > 0) error stop 'door_test failed'

contains

  subroutine check(holds, what)
    logical, intent(in) :: holds
    character(len=*), intent(in) :: what

    if (holds) return
    failures = failures + 1
    write (error_unit, '(2a)') 'failed: ', what
  end subroutine

  pure logical function same_bits(a, b)
    real(dp), intent(in) :: a(:, :), b(:, :)

    same_bits = size(a) == size(b) .and. all(transfer(a, [0_int64]) == transfer(b, [0_int64]))
  end function

  !> `stat` and `message` of the call just made.
  subroutine check_refused(status, words)
    integer(int32), intent(in) :: status
    character(len=*), intent(in) :: words

    call check(stat == status .and. index(message, words) > 0, &
               'wanted "'//words//'", got "'//trim(message)//'"')
    message = ''
  end subroutine

  subroutine copies_own()
    type(cdfp_model) :: first, second, list(2)
    type(cdfp_model), allocatable :: third

    call first%create()
    call check(live_handles() == 1, 'one owner')
    second = first
    call check(live_handles() == 2, 'a copy is one more owner')
    call first%free()
    call first%free()
    call check_lives(second, 'a copy survives the original')
    call check(live_handles() == 1, 'one is left')
    second = second
    call check_lives(second, 'assignment to itself keeps the object')
    call check(live_handles() == 1, 'and makes no owner')
    second = first
    call check(live_handles() == 0, 'assigning nothing lets go')

    call second%create()
    call second%create()
    call check(live_handles() == 1, 'made anew, the old object goes')
    allocate (third)
    third = second
    list(1) = second
    list(2) = list(1)
    call check(live_handles() == 4, 'owners in an array')
    call second%free()
    deallocate (third)
    call check(live_handles() == 2, 'a variable that ceases to exist lets go')
    call check_lives(list(2), 'the array still owns')
    call keep_for_a_while(list(1))
    call check(live_handles() == 2, 'a local copy takes only its own share with it')
  end subroutine

  subroutine keep_for_a_while(model)
    type(cdfp_model), intent(in) :: model
    type(cdfp_model) :: local

    local = model
    call check(live_handles() == 3, 'a local copy is an owner')
  end subroutine

  !> Copies that the compiler makes by itself name the object; the owner keeps it and lets go of it.
  subroutine copies_by_the_compiler()
    type(cdfp_model) :: owner
    type(cdfp_model), allocatable :: list(:)
    type(holder) :: a, b

    call owner%create()
    call copy_holder(owner, a, b)
    list = [owner, owner]
    list = [list, owner]
    call check(live_handles() == 1, 'no more owners')
    call check_lives(a%model, 'in a structure constructor')
    call check_lives(b%model, 'in a component')
    call check_lives(list(3), 'in an array')
    deallocate (list)
    call check_lives(owner, 'the copies that went took nothing with them')
    call owner%free()
    call b%model%set_title('x', stat, message)
    call check_refused(CDFP_BAD_ARGUMENT, 'the model is not alive')
    call b%model%free()
  end subroutine

  subroutine copy_holder(model, one, other)
    type(cdfp_model), intent(in) :: model
    type(holder), intent(inout) :: one, other

    one = holder(model)
    other = one
  end subroutine

  subroutine check_lives(model, what)
    type(cdfp_model), intent(in) :: model
    character(len=*), intent(in) :: what

    call model%set_title('alive', stat)
    call check(stat == CDFP_OK, what)
  end subroutine

  subroutine define(model)
    type(cdfp_model), intent(inout) :: model

    call model%create()
    call model%set_mesh(coordinates, hexahedra, parts, layers)
    call model%add_node_set('bottom', [1_int32, 2_int32, 3_int32, 4_int32])
    call model%add_elastic_material('glass', density=2500.0_dp, youngs_modulus=74e9_dp, poissons_ratio=0.2_dp)
    call model%add_part('cubes', 'glass')
    call model%set_time(end=0.1_dp)
    call model%set_threads(1)
  end subroutine

  subroutine wrong_calls()
    type(cdfp_model) :: model
    type(cdfp_simulation) :: sim
    type(cdfp_topology) :: tops
    real(dp), pointer :: x(:, :)
    real(dp) :: time, seconds, position(3)
    integer(int32) :: mate(2)
    integer(int32), allocatable :: nodes(:)
    integer :: layer

    message = ''
    call model%set_title('x', stat, message)
    call check_refused(CDFP_BAD_ARGUMENT, 'the model is null')
    call sim%create(model, stat, message)
    call check_refused(CDFP_BAD_ARGUMENT, 'the model is null')
    x => sim%positions(stat, message)
    call check_refused(CDFP_BAD_ARGUMENT, 'the simulation is null')
    call check(.not. associated(x), 'no view of nothing')
    time = sim%time(stat, message)
    call check_refused(CDFP_BAD_ARGUMENT, 'the simulation is null')
    call check(abs(time) <= 0, 'a failed query is 0')

    call define(model)
    call model%set_mesh(coordinates(1:2, :), hexahedra, parts, stat=stat, errmsg=message)
    call check_refused(CDFP_BAD_ARGUMENT, 'coordinates must be of shape (3, nodes)')
    call model%set_mesh(coordinates, hexahedra(1:7, :), parts, stat=stat, errmsg=message)
    call check_refused(CDFP_BAD_ARGUMENT, 'hexahedra must be of shape (8, elements)')
    call model%set_mesh(coordinates, hexahedra, parts(1:1), stat=stat, errmsg=message)
    call check_refused(CDFP_BAD_ARGUMENT, 'one part for each element')
    call model%set_mesh(coordinates, hexahedra, parts, layers(1:1), stat, message)
    call check_refused(CDFP_BAD_ARGUMENT, 'one layer for each element')
    call model%add_facet_set('set', reshape([1_int32, 2_int32, 3_int32], [3, 1]), stat, message)
    call check_refused(CDFP_BAD_ARGUMENT, 'facets must be of shape (2, n)')
    call model%add_node_set('  ', [1_int32], stat, message)
    call check_refused(CDFP_BAD_ARGUMENT, "'name' is empty")
    call model%add_part('x', 'glass', formulation=9_int32, stat=stat, errmsg=message)
    call check_refused(CDFP_BAD_ARGUMENT, 'formulation is 9')
    call model%add_symmetry_plane(0, 0.0_dp, stat, message)
    call check_refused(CDFP_BAD_ARGUMENT, 'no axis 0')
    call model%add_prescribed_velocity('bottom', [.true., .true., .true.], values=[1.0_dp], &
                                       times=[0.0_dp, 1.0_dp], stat=stat, errmsg=message)
    call check_refused(CDFP_BAD_ARGUMENT, 'one value for each time')

    call model%add_node_set('numbers from 0', [0_int32])
    call sim%create(model, stat, message)
    call check_refused(CDFP_BAD_MESH, 'node 0 does not exist (nodes are numbered 1 to 12)')

    call define(model)
    call sim%create(model, stat, message)
    call check(stat == CDFP_OK .and. len_trim(message) == 0, 'errmsg is untouched by success: '//message)
    call sim%first_crack('cubes', seconds, layer, position, stat, message)
    call check_refused(CDFP_BAD_ARGUMENT, 'that may crack')
    call check(len(sim%warning(5, stat, message)) == 0, 'no text of a warning that is not there')
    call check_refused(CDFP_BAD_ARGUMENT, 'no warning 5')

    call tops%create(12, hexahedra(:4, :), stat, message)
    call check_refused(CDFP_BAD_ARGUMENT, 'must be of shape (8, elements)')
    call tops%create(12, hexahedra)
    call tops%get_mate(3_int32, 1_int32, mate(1), mate(2), stat, message)
    call check_refused(CDFP_BAD_ARGUMENT, 'no element 3')
    call tops%get_nodes(0_int32, nodes, stat, message)
    call check_refused(CDFP_BAD_ARGUMENT, 'no element 0')
    call check(.not. allocated(nodes), 'nothing comes of a refused call')
  end subroutine

  subroutine topology()
    type(cdfp_topology) :: tops, mixed
    integer(int32), allocatable :: nodes(:), uses(:, :), new_nodes(:, :), renumbered(:, :)
    integer(int32) :: mate(2), cohesive, facet, inner
    integer :: i

    call tops%create(12, hexahedra)
    inner = 0
    do facet = 1, int(tops%facet_count(1_int32), int32)
      call tops%get_mate(1_int32, facet, mate(1), mate(2))
      if (mate(1) == 2) inner = facet
    end do
    call tops%get_facet_nodes(1_int32, inner, nodes)
    call check(size(nodes) == 4 .and. all(nodes >= 5 .and. nodes <= 8), 'nodes of the facet between the cubes')
    call tops%get_elements_around_node(5_int32, uses)
    call check(all(shape(uses) == [2, 2]), 'two elements around a node')
    call check(all(reshape(uses, [4]) == [1, 5, 2, 1]), 'element and corner, from 1')
    call check(tops%edge_count(1_int32) == 12, 'edges of a cube')
    call tops%get_edge_nodes(1_int32, 1_int32, mate)
    call check(all(mate == [1, 2]), 'the first edge')
    call tops%get_elements_around_edge(1_int32, 1_int32, uses)
    call check(all(shape(uses) == [2, 1]) .and. uses(1, 1) == 1, 'an edge of one element')

    call tops%insert_cohesive(1_int32, inner, cohesive, new_nodes, renumbered)
    call check(tops%element_count() == 3 .and. cohesive == 3, 'the cohesive element comes after the bulk')
    call check(tops%bulk_count() == 2, 'the bulk stays')
    call check(tops%element_type(cohesive) == CDFP_COHESIVE_QUADRILATERAL, 'its type')
    call check(tops%node_count() == 16, 'four nodes were split')
    call check(all(new_nodes(1, :) == [13, 14, 15, 16]) .and. all(new_nodes(2, :) >= 5), 'copies and mothers')
    do i = 1, size(renumbered, 2)
      call tops%get_nodes(renumbered(1, i), nodes)
      call check(nodes(renumbered(2, i)) == renumbered(4, i), 'corners name the new nodes')
      call check(any(new_nodes(1, :) == renumbered(4, i) .and. new_nodes(2, :) == renumbered(3, i)), &
                 'each by its mother')
    end do
    call tops%get_mate(1_int32, inner, mate(1), mate(2))
    call check(mate(1) == 3, 'a cohesive element stands between')
    call check(tops%check() == '', 'all relations hold')

    call mixed%create(5, [CDFP_TETRAHEDRON, CDFP_TETRAHEDRON], &
                      [integer(int32) :: 1, 2, 3, 4, 2, 3, 4, 5])
    call check(mixed%element_count() == 2, 'two tetrahedra')
    call check(mixed%facet_count(2_int32) == 4, 'of four facets')
  end subroutine

  !> A bar under gravity falls as a whole.
  subroutine simulation()
    type(cdfp_model) :: model
    type(cdfp_simulation) :: sim, same
    type(cdfp_energies) :: energy
    type(cdfp_summary) :: told
    real(dp), pointer :: x(:, :), v(:, :), f(:, :), m(:), history(:, :)
    integer :: done
    integer(int32) :: element
    integer(int64) :: calls
    character(len=:), allocatable :: stage, name
    type(cdfp_contact_pair) :: between
    real(dp) :: t

    call define(model)
    call model%set_gravity([0.0_dp, 0.0_dp, -10.0_dp])
    call model%add_initial_velocity('cubes', [1.0_dp, 0.0_dp, 0.0_dp])
    call sim%create(model)
    call model%free()
    x => sim%positions()
    call check(same_bits(x, coordinates), 'positions at the start are the coordinates')
    call sim%advance(100, done)
    call check(sim%step_count() == 100 .and. done == 100, 'a hundred steps')
    same = sim
    call same%step()
    call check(sim%step_count() == 101, 'a copy names the same simulation')

    x => sim%positions()
    v => sim%velocities()
    f => sim%forces()
    m => sim%masses()
    t = sim%time()
    call check(sim%node_count() == 12 .and. size(x, 2) == 12, 'views of all nodes')
    call check(abs(sum(m) - 5000) < 1e-9_dp, 'mass')
    call check(all(abs(x(1, :) - coordinates(1, :) - t) < 1e-12_dp), 'flight')
    call check(all(abs(x(3, :) - coordinates(3, :) + 5*t**2) < 1e-9_dp), 'fall')
    call check(all(abs(v(3, :) + 10*(t + sim%step_size()/2)) < 1e-9_dp), 'velocities half a step ahead')
    call check(abs(sum(f(3, :)) + 50000) < 1e-6_dp, 'weight')
    energy = sim%energies()
    call check(abs(energy%balance - 1) < 1e-9_dp .and. energy%kinetic > 2500, 'energies')
    element = sim%controlling_element()
    call check(element == 1 .or. element == 2, 'elements from 1')
    call check(.not. sim%finished(), 'under way')
    call check(sim%body_count() == 0, 'no rigid body')
    call sim%advance_to(0.05_dp)
    call check(abs(sim%time() - 0.05_dp) <= 0.5_dp*sim%step_size(), 'the step nearest to a time')
    call sim%advance(huge(1))
    call check(sim%finished(), 'the end')
    told = sim%summary()
    call check(sim%step_count() == told%steps .and. told%elements == 2 .and. told%threads == 1, 'summary')
    call sim%get_stage(sim%stage_count(), stage, t, calls)
    call check(stage == 'accelerate' .and. calls == told%steps .and. t > 0, 'the last stage of the step')
    call check(sim%contact_pair_count() == 0, 'nothing has touched')
    call sim%get_contact_pair(1, stage, name, between, stat, message)
    call check_refused(CDFP_BAD_ARGUMENT, 'no contact pair 1')
    call sim%get_stage(0, stage, t, calls, stat, message)
    call check_refused(CDFP_BAD_ARGUMENT, 'no stage 0')
    history => sim%history()
    call check(sim%history_column(1) == 'time_s' .and. size(history, 2) > 2, 'history')
    call check(same_bits(history(:1, size(history, 2):), reshape([sim%time()], [1, 1])), 'its last row')
  end subroutine

  subroutine plate()
    type(cdfp_laminated_plate) :: size_of_plate
    type(cdfp_mesh) :: mesh
    real(dp), allocatable :: x(:, :)
    integer(int32), allocatable :: elements(:, :), part(:), layer(:), nodes(:), facets(:, :)

    call default_laminated_plate(size_of_plate)
    size_of_plate%columns = 4
    size_of_plate%layout = CDFP_REGULAR
    call mesh%create_laminated_plate(size_of_plate)
    call mesh%get_coordinates(x)
    call mesh%get_hexahedra(elements)
    call mesh%get_parts(part)
    call mesh%get_layers(layer)
    call check(minval(elements) == 1 .and. maxval(elements) == size(x, 2), 'nodes from 1')
    call check(mesh%part_count() == maxval(part) .and. minval(part) == 1, 'parts from 1')
    call check(mesh%part_name(1) == 'lower_glass', 'name of the first part')
    call check(minval(layer) == 1 .and. maxval(layer, mask=part == 1) == 5, 'layers from 1')
    call mesh%get_node_set('support_bottom', nodes)
    call check(size(nodes) == 25 .and. all(x(3, nodes) <= minval(x(3, :))), 'the bottom')
    call mesh%get_facet_set('support_top', facets)
    call check(size(facets, 1) == 2 .and. size(facets, 2) == 16 .and. minval(facets(2, :)) >= 1, 'a face')
  end subroutine

  !> Two cubes whose nodes are their own: 5 to 8 below, 9 to 12 above, at the same places.
  subroutine halves(x, v, f, mass)
    real(dp), allocatable, intent(out) :: x(:, :), v(:, :), f(:, :), mass(:)

    allocate (x(3, 16), v(3, 16), f(3, 16), mass(16))
    x(:, :8) = coordinates(:, :8)
    x(:, 9:) = coordinates(:, 5:)
    v = 0
    f = 0
    mass = 312.5_dp
  end subroutine

  subroutine cohesive_service()
    type(cdfp_cohesive) :: cohesive, same
    type(cdfp_topology) :: tops
    type(cdfp_cohesive_law) :: law
    type(cdfp_cohesive_pair), allocatable :: pairs(:)
    type(cdfp_cohesive_point) :: points(1)
    real(dp), allocatable :: x(:, :), v(:, :), f(:, :), mass(:), tractions(:, :)
    real(dp) :: stress(6, 2), traction(3, 1), normal(3, 1), opening(3, 1), stored(1), reach
    real(dp) :: energy(4), none
    integer(int32) :: number
    integer(int32), allocatable :: facets(:, :), broken(:)

    call halves(x, v, f, mass)
    law = new_cohesive_law(strength=60e6_dp, fracture_energy=10.0_dp, mode_ratio=5.0_dp)
    call cohesive%add_law(law, number, stat, message)
    call check_refused(CDFP_BAD_ARGUMENT, 'the cohesive service is null')
    call check(number == 0, 'no law of nothing')
    call tops%create(12, hexahedra)
    call cohesive%create(tops)
    call cohesive%add_law(law, number)
    call check(number == 1, 'laws from 1')
    call cohesive%find_open(tops, coordinates, stress, facets, tractions, stat=stat, errmsg=message)
    call check_refused(CDFP_BAD_STATE, 'call cdfp_cohesive_set_parts first')
    call cohesive%set_parts(tops, coordinates, [1_int32, 2_int32], law_of_part=[number], stat=stat, errmsg=message)
    call check_refused(CDFP_BAD_ARGUMENT, 'element 2 is of part 2')
    call cohesive%set_parts(tops, coordinates, parts, law_of_part=[number])
    stress = 0
    stress(3, :) = 61e6_dp
    call cohesive%find_open(tops, coordinates, stress(1:5, :), facets, tractions, stat=stat, errmsg=message)
    call check_refused(CDFP_BAD_ARGUMENT, 'stress of shape (6, elements)')
    call cohesive%find_open(tops, coordinates, stress, facets, tractions)
    call check(all(shape(facets) == [3, 1]) .and. facets(1, 1) == 1 .and. facets(3, 1) == 1, 'element and law from 1')
    call check(abs(tractions(3, 1) - 61e6_dp) < 1, 'the traction of the facet')

    call cohesive%insert(3_int32, 1_int32, [integer(int32) :: 9, 10, 11, 12, 5, 6, 7, 8], x, 0.0_dp, &
                         [0.0_dp, 0.0_dp, 60e6_dp])
    same = cohesive
    call check(same%element_count() == 1, 'a copy names the same elements')
    call cohesive%add_force(x, v, mass(:15), f, 1e-6_dp, 0.0_dp, stat=stat, errmsg=message)
    call check_refused(CDFP_BAD_ARGUMENT, 'add_force: x, v and f must be of shape (3, nodes)')
    x(2, 9) = ieee_nan()
    call cohesive%add_force(x, v, mass, f, 1e-6_dp, 0.0_dp, stat=stat, errmsg=message)
    call check_refused(CDFP_BAD_ARGUMENT, 'node 9 of a cohesive element')
    x(2, 9) = 0
    f(3, 9:12) = 15e6_dp
    f(3, 5:8) = -15e6_dp
    call cohesive%add_force(x, v, mass, f, 1e-6_dp, 0.0_dp)
    call check(all(abs(f) < 15e3_dp), 'the facet carries what pulls')
    call cohesive%get_pairs(3_int32, pairs)
    call check(size(pairs) == 4 .and. pairs(1)%upper == 9 .and. pairs(1)%lower == 5, 'nodes from 1')
    call check(abs(sum(pairs%area) - 1) < 1e-12_dp .and. abs(pairs(1)%strength - 60e6_dp) < 1, 'area and strength')
    call cohesive%get_broken(broken)
    call check(size(broken) == 0, 'none has broken')
    call check(cohesive%broken_count() == 0, 'nor before')
    call cohesive%get_energies(energy(1), energy(2), energy(3), energy(4))
    call check(all(abs(energy) < 1), 'energies')
    none = cohesive%stiffness_over_mass(mass)
    call check(abs(none) <= 0, 'built-in laws bound no step')
    call cohesive%follow(reshape([1_int32], [1, 1]), reshape([1_int32], [1, 1]), stat, message)
    call check_refused(CDFP_BAD_ARGUMENT, 'follow: new_nodes must be of shape (2, n)')
    call cohesive%free()
    call cohesive%free()
    call check(same%element_count() == 1, 'the copy still owns')

    reach = 2*10.0_dp/60e6_dp
    traction(:, 1) = [0.0_dp, 0.0_dp, 60e6_dp]
    normal(:, 1) = [0.0_dp, 0.0_dp, 1.0_dp]
    opening(:, 1) = [0.0_dp, 0.0_dp, reach/2]
    call start_cohesive(law, traction, normal, points)
    call cohesive_traction(law, opening, normal, points, traction)
    call check(abs(traction(3, 1) - 30e6_dp) < 1, 'half the traction at half the reach')
    call cohesive_stored(law, normal, points, stored)
    call check(abs(stored(1) - 2.5_dp) < 1e-9_dp, 'stored')
    call cohesive_mean_traction(law, 2*opening, normal, points, traction)
    call check(abs(points(1)%dissipated - 10) < 1e-9_dp, 'fracture energy')
    call cohesive_traction(law, opening(:2, :), normal, points, traction, stat, message)
    call check_refused(CDFP_BAD_ARGUMENT, 'must be of shape (3, points)')
  end subroutine

  pure real(dp) function ieee_nan()
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value

    ieee_nan = ieee_value(1.0_dp, ieee_quiet_nan)
  end function

  subroutine contact_service()
    type(cdfp_contact) :: contact
    type(cdfp_contact_search) :: search
    type(cdfp_touch), allocatable :: touches(:)
    type(cdfp_body_pair), allocatable :: pairs(:)
    real(dp), allocatable :: x(:, :), v(:, :), f(:, :), mass(:)
    real(dp) :: weights(4), normal(3), gap, outside, stored, heat, deepest, added
    integer(int32), allocatable :: start(:), partners(:), nodes(:)
    integer(int32), parameter :: faces(4, 2) = reshape([integer(int32) :: 5, 6, 7, 8, 9, 12, 11, 10], [4, 2])
    integer(int32), parameter :: of_faces(8) = [integer(int32) :: 5, 6, 7, 8, 9, 10, 11, 12], no_edges(2, 0) = 0
    integer(int64) :: counted(4)

    call halves(x, v, f, mass)
    call search%create()
    call search%regular(x, of_faces, faces(:3, :), no_edges, stat=stat, errmsg=message)
    call check_refused(CDFP_BAD_ARGUMENT, 'segments of shape (4, m)')
    call search%adaptive(x, of_faces, faces, no_edges, stat=stat, errmsg=message)
    call check_refused(CDFP_BAD_STATE, 'needs a regular one before')
    call search%regular(x, of_faces, faces, no_edges)
    call search%get_node_segments(start, partners)
    call check(all(start == [integer(int32) :: 1, 2, 3, 4, 5, 6, 7, 8, 9]), 'rows from 1')
    call check(all(partners == [integer(int32) :: 2, 2, 2, 2, 1, 1, 1, 1]), 'segments from 1')
    call search%regular(x, of_faces, faces, no_edges, groups=spread(1_int32, 1, 16))
    call search%get_node_segments(start, partners)
    call check(size(partners) == 0, 'one group does not pair')
    call check(.not. search%due(0.0_dp, 1e-6_dp), 'nothing moves')
    call project_on_face([0.25_dp, 0.5_dp, 0.5_dp], coordinates(:, 5:8), weights, normal, gap, outside)
    call check(abs(gap + 0.5_dp) < 1e-12_dp .and. abs(sum(weights) - 1) < 1e-12_dp, 'projection')
    call project_on_face([0.25_dp, 0.5_dp, 0.5_dp], coordinates(:, 5:6), weights, normal, gap, outside, stat, message)
    call check_refused(CDFP_BAD_ARGUMENT, '3 or 4 corners, not 2')

    call contact%create(friction=0.1_dp, depth_limit=2.0_dp, stat=stat, errmsg=message)
    call check_refused(CDFP_BAD_ARGUMENT, 'depth_limit in (0, 1]')
    call contact%local_search(x, stat=stat, errmsg=message)
    call check_refused(CDFP_BAD_ARGUMENT, 'the contact is null')
    call contact%create(friction=0.1_dp)
    call contact%name_part(1, 'below')
    call contact%name_part(2, 'above')
    call contact%add_segments(faces, [1_int32], [1_int32, 2_int32], [1e9_dp, 1e9_dp], [1.0_dp, 1.0_dp], &
                              [1.0_dp, 1.0_dp], stat, message)
    call check_refused(CDFP_BAD_ARGUMENT, 'all others of shape (n)')
    call contact%add_segments(faces, [1_int32, 2_int32], [1_int32, 2_int32], [1e9_dp, 1e9_dp], [1.0_dp, 1.0_dp], &
                              [1.0_dp, 1.0_dp])
    call contact%local_search(x, stat=stat, errmsg=message)
    call check_refused(CDFP_BAD_STATE, 'ask `due`')
    x(3, 9:) = x(3, 9:) - 1e-3_dp
    v(3, 9:) = -1e3_dp
    call contact%search(x, v, 1e-6_dp)
    call contact%local_search(x)
    call contact%add_force(v, mass, f, 1e-6_dp)
    call check(all(f(3, 9:12) > 0) .and. all(f(3, 5:8) < 0) .and. abs(sum(f(3, :))) < 1e-3_dp, 'action and reaction')
    call contact%get_touches(touches)
    call check(size(touches) == 8 .and. touches(1)%nodes(1) == 5 .and. all(touches(1)%parts == [1, 2]), 'touches')
    call contact%get_body_pairs(pairs)
    call check(size(pairs) == 1 .and. all(pairs(1)%parts == [1, 2]) .and. pairs(1)%force(3) < 0, 'pair of bodies')
    call contact%get_counts(counted(1), counted(2), counted(3), counted(4))
    call check(all(counted == [8, 2, 0, 8]), 'counts')
    call contact%get_nodes(nodes)
    call check(all(nodes == [integer(int32) :: 5, 6, 7, 8, 9, 12, 11, 10]), 'contact nodes from 1')
    call contact%get_node_segments(start, partners)
    call check(size(start) == 9 .and. partners(1) == 2, 'candidates')
    call contact%get_energies(stored, heat, deepest)
    call check(stored > 0 .and. deepest > 0.9e-3_dp, 'energies')
    added = contact%stiffness_over_mass()
    call check(added > 0, 'springs bound the step')
    call contact%remove_elements([2_int32])
    call contact%local_search(x)
    call contact%get_touches(touches)
    call check(size(touches) == 0, 'nothing touches an element that is no more')
    call contact%remove_elements([0_int32], stat, message)
    call check_refused(CDFP_BAD_ARGUMENT, 'cannot leave the surface')
    v(1, 5) = ieee_nan()
    call contact%search(x, v, 1e-6_dp, stat=stat, errmsg=message)
    call check_refused(CDFP_BAD_ARGUMENT, 'velocity of node 5 is not finite')
  end subroutine

  subroutine state_between_steps()
    type(cdfp_model) :: model
    type(cdfp_simulation) :: sim, again, same
    type(cdfp_energies) :: energy
    real(dp), pointer :: view(:, :)
    real(dp), allocatable :: v(:, :)
    integer :: unit
    real(dp) :: stress(6, 2)

    call define(model)
    call sim%create(model)
    call sim%advance(2)
    view => sim%velocities()
    v = view
    v(1, :) = 3
    call sim%set_velocities(v(:, :11), stat, message)
    call check_refused(CDFP_BAD_ARGUMENT, 'the 12 nodes')
    call sim%set_velocities(v(:2, :), stat, message)
    call check_refused(CDFP_BAD_ARGUMENT, 'must be of shape (3, nodes)')
    call sim%set_velocities(v)
    energy = sim%energies()
    call check(abs(energy%kinetic - 0.5_dp*5000*9) < 1e-6_dp .and. abs(energy%balance - 1) < 1e-12_dp, 'pushed')
    call sim%advance(3)
    view => sim%velocities()
    call check(all(abs(view(1, :) - 3) < 1e-9_dp), 'and flies on')
    view => sim%positions()
    v = view
    v(3, :) = v(3, :)*(1 + 1e-5_dp)
    call sim%set_positions(v)
    call sim%get_stresses(stress)
    call check(all(abs(stress(3, :) - 1e-5_dp*74e9_dp*0.8_dp/(1.2_dp*0.6_dp)) < 1e3_dp), 'stretched')
    call sim%save('door_test_restart')
    call again%create(model)
    call again%restore('door_test_restart')
    call sim%advance(4)
    call again%advance(4)
    call check(again%step_count() == sim%step_count(), 'steps of the run that went on')
    call check(same_bits(again%positions(), sim%positions()), 'the same bits')
    call again%restore('door_test_restart', stat, message)
    call check_refused(CDFP_BAD_STATE, '9 steps')
    call same%create(model)
    call same%restore('no such file', stat, message)
    call check_refused(CDFP_IO, 'cannot read the restart file')
    open (newunit=unit, file='door_test_restart')
    close (unit, status='delete')
    call sim%get_stresses(stress(:, :1), stat, message)
    call check_refused(CDFP_BAD_ARGUMENT, 'the simulation has 2')
  end subroutine

end program door_test
