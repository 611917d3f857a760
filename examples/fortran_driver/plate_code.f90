!> An explicit finite-element code of its own: its arrays, its elements, its time loop. What it takes from cdfp
!> are the services: TopS for the mesh's adjacency, cohesive elements, contact.
!>
!> Arrays of nodes have room to spare; x(:, :n) and the like are the nodes that there are.
module plate_code
  use, intrinsic :: iso_fortran_env, only: dp => real64, int32
  use cdfp
  use plate_scene
  implicit none
  private

  type, public :: code
    integer :: n = 0                               !< nodes
    real(dp), allocatable :: x0(:, :), x(:, :)     !< m: undeformed, now
    real(dp), allocatable :: v(:, :), f(:, :)      !< m/s half a step behind or ahead, N
    real(dp), allocatable :: mass(:)
    logical, allocatable :: clamped(:)
    integer(int32), allocatable :: tets(:, :), parts(:)
    real(dp), allocatable :: gradient(:, :, :)     !< (3, 4, elements): of the shape functions, undeformed
    real(dp), allocatable :: volume(:)
    real(dp), allocatable :: stress(:, :)          !< (6, elements): Cauchy, xx yy zz xy yz zx
    real(dp) :: step = 0, time = 0
    real(dp) :: kinetic = 0, strain = 0            !< J
    integer :: threads = 1
    type(cdfp_topology) :: topology
    type(cdfp_cohesive) :: cohesive
    type(cdfp_contact) :: contact
  contains
    procedure :: set_up
    procedure :: forces
    procedure :: drift
    procedure :: accelerate
    procedure :: stable_step
    procedure :: internal_force
    procedure :: open_facets
    procedure :: contact_force
    procedure :: cohesive_force
    procedure, private :: element_force
    procedure, private :: split_node
    procedure, private :: divide
  end type

contains

  subroutine set_up(this, s)
    class(code), intent(inout) :: this
    type(scene), intent(in) :: s
    integer(int32) :: law
    integer :: e

    this%n = size(s%x, 2)
    this%x0 = s%x
    this%x = s%x
    this%tets = s%tets
    this%parts = s%parts
    allocate (this%v(3, this%n), this%f(3, this%n), this%mass(this%n), source=0.0_dp)
    allocate (this%clamped(this%n), source=.false.)
    this%clamped(s%clamped) = .true.
    allocate (this%gradient(3, 4, size(s%parts)), this%volume(size(s%parts)), this%stress(6, size(s%parts)))
    do e = 1, size(s%parts)
      call shape_of(this%x0(:, this%tets(:, e)), this%gradient(:, :, e), this%volume(e))
      this%mass(this%tets(:, e)) = this%mass(this%tets(:, e)) + corner_mass(this, e)
      if (s%parts(e) == pellet) this%v(3, this%tets(:, e)) = -pellet_speed
    end do

    ! (a) the topology of the program's own connectivity
    call this%topology%create(this%n, spread(CDFP_TETRAHEDRON, 1, size(s%parts)), reshape(s%tets, [size(s%tets)]))

    ! (b) a law, and which part follows it
    call this%cohesive%create(this%topology)
    call this%cohesive%add_law(new_cohesive_law(strength, fracture_energy, mode_ratio=mode_ratio, &
                                                friction=friction), law)
    call this%cohesive%set_parts(this%topology, this%x0, this%parts, law_of_part=[law, 0_int32])
    call this%cohesive%hold(s%clamped, [.true., .true., .true.])

    ! (c) the outer faces of both bodies
    call this%contact%create(friction=friction)
    call this%contact%add_facets(this%topology, this%x0, s%faces, this%parts, bulk_modulus(material))
  end subroutine

  !> All forces at `x`. `kick`: the span of the change of velocity that follows.
  subroutine forces(this, kick)
    class(code), intent(inout) :: this
    real(dp), intent(in) :: kick

    call this%internal_force()
    call this%open_facets()
    call this%contact_force(kick)
    call this%cohesive_force(kick)
  end subroutine

  subroutine drift(this)
    class(code), intent(inout) :: this

    this%x(:, :this%n) = this%x(:, :this%n) + this%step*this%v(:, :this%n)
    this%time = this%time + this%step
  end subroutine

  subroutine accelerate(this, kick)
    class(code), intent(inout) :: this
    real(dp), intent(in) :: kick
    real(dp) :: ahead(3)
    integer :: i

    this%kinetic = 0
    do i = 1, this%n
      if (this%clamped(i)) cycle
      ahead = this%v(:, i) + kick/this%mass(i)*this%f(:, i)
      this%kinetic = this%kinetic + 0.5_dp*this%mass(i)*dot_product(this%v(:, i), ahead)
      this%v(:, i) = ahead
    end do
  end subroutine

  !> The time that a wave takes over the smallest height of an element.
  real(dp) function stable_step(this)
    class(code), intent(in) :: this
    real(dp) :: steepest
    integer :: e

    stable_step = huge(stable_step)
    do e = 1, size(this%parts)
      steepest = sqrt(maxval(sum(this%gradient(:, :, e)**2, dim=1)))
      associate (m => material(this%parts(e)))
        stable_step = min(stable_step, sqrt(m%density/(lambda(m) + 2*mu(m)))/steepest)
      end associate
    end do
  end function

  subroutine internal_force(this)
    class(code), intent(inout) :: this
    real(dp) :: corner(3, 4), energy
    integer :: e, a

    this%f(:, :this%n) = 0
    this%strain = 0
    do e = 1, size(this%parts)
      call this%element_force(e, corner, this%stress(:, e), energy)
      this%strain = this%strain + energy
      do a = 1, 4
        associate (i => this%tets(a, e))
          this%f(:, i) = this%f(:, i) + corner(:, a)
        end associate
      end do
    end do
  end subroutine

  !> Second Piola-Kirchhoff stress, linear in Green-Lagrange strain, of a linear tetrahedron.
  subroutine element_force(this, e, corner, cauchy, energy)
    class(code), intent(in) :: this
    integer, intent(in) :: e
    real(dp), intent(out) :: corner(3, 4), cauchy(6), energy
    real(dp) :: u(3, 4), g(3, 4), h(3, 3), f(3, 3), strain(3, 3), s(3, 3), p(3, 3), full(3, 3), trace, l, m
    integer :: i, j

    l = lambda(material(this%parts(e)))
    m = mu(material(this%parts(e)))
    do j = 1, 4
      associate (node => this%tets(j, e))
        u(:, j) = this%x(:, node) - this%x0(:, node)
      end associate
      g(:, j) = this%gradient(:, j, e)
    end do
    do j = 1, 3
      h(:, j) = u(:, 1)*g(j, 1) + u(:, 2)*g(j, 2) + u(:, 3)*g(j, 3) + u(:, 4)*g(j, 4)
    end do
    f = h
    do j = 1, 3
      do i = 1, 3
        strain(i, j) = 0.5_dp*(h(i, j) + h(j, i) + h(1, i)*h(1, j) + h(2, i)*h(2, j) + h(3, i)*h(3, j))
      end do
      f(j, j) = f(j, j) + 1
    end do
    trace = strain(1, 1) + strain(2, 2) + strain(3, 3)
    s = 2*m*strain
    do i = 1, 3
      s(i, i) = s(i, i) + l*trace
    end do
    do j = 1, 3
      p(:, j) = f(:, 1)*s(1, j) + f(:, 2)*s(2, j) + f(:, 3)*s(3, j)
    end do
    do j = 1, 3
      full(:, j) = (p(:, 1)*f(j, 1) + p(:, 2)*f(j, 2) + p(:, 3)*f(j, 3))/determinant(f)
    end do
    cauchy = [full(1, 1), full(2, 2), full(3, 3), full(1, 2), full(2, 3), full(3, 1)]
    do j = 1, 4
      corner(:, j) = -this%volume(e)*(p(:, 1)*g(1, j) + p(:, 2)*g(2, j) + p(:, 3)*g(3, j))
    end do
    energy = 0.5_dp*this%volume(e)*sum(s*strain)
  end subroutine

  !> Facets that reach their strength become cohesive elements; the program's arrays follow.
  subroutine open_facets(this)
    class(code), intent(inout) :: this
    integer(int32), allocatable :: facets(:, :), new_nodes(:, :), renumbered(:, :), nodes(:), split(:)
    real(dp), allocatable :: tractions(:, :)
    integer(int32) :: element
    integer :: i, j

    call this%cohesive%find_open(this%topology, this%x(:, :this%n), this%stress, facets, tractions, &
                                 this%threads)
    if (size(facets, 2) == 0) return
    allocate (split(0))
    do i = 1, size(facets, 2)
      call this%topology%insert_cohesive(facets(1, i), facets(2, i), element, new_nodes, renumbered)
      do j = 1, size(new_nodes, 2)
        call this%split_node(new_nodes(2, j))
      end do
      do j = 1, size(renumbered, 2)
        if (renumbered(1, j) > size(this%parts)) cycle
        this%tets(renumbered(2, j), renumbered(1, j)) = renumbered(4, j)
      end do
      call this%cohesive%follow(new_nodes, renumbered)
      call this%contact%follow(new_nodes, renumbered)
      call this%topology%get_nodes(element, nodes)
      call this%cohesive%insert(element, facets(3, i), nodes, this%x(:, :this%n), this%time, tractions(:, i))
      split = [split, reshape(new_nodes, [size(new_nodes)])]
    end do
    call this%divide(split)
  end subroutine

  !> The next node is a copy of `mother`.
  subroutine split_node(this, mother)
    class(code), intent(inout) :: this
    integer(int32), intent(in) :: mother

    if (this%n == size(this%mass)) call make_room(this)
    this%n = this%n + 1
    this%x0(:, this%n) = this%x0(:, mother)
    this%x(:, this%n) = this%x(:, mother)
    this%v(:, this%n) = this%v(:, mother)
    this%clamped(this%n) = this%clamped(mother)
  end subroutine

  subroutine make_room(this)
    class(code), intent(inout) :: this
    integer :: more

    more = this%n/4 + 100
    call grow(this%x0)
    call grow(this%x)
    call grow(this%v)
    call grow(this%f)
    this%mass = [this%mass, spread(0.0_dp, 1, more)]
    this%clamped = [this%clamped, spread(.false., 1, more)]

  contains

    subroutine grow(field)
      real(dp), allocatable, intent(inout) :: field(:, :)
      real(dp), allocatable :: longer(:, :)

      allocate (longer(3, this%n + more))
      longer(:, :this%n) = field
      call move_alloc(longer, field)
    end subroutine

  end subroutine

  !> Masses and forces of nodes whose elements changed.
  subroutine divide(this, nodes)
    class(code), intent(inout) :: this
    integer(int32), intent(in) :: nodes(:)
    integer(int32), allocatable :: uses(:, :)
    real(dp) :: corner(3, 4), cauchy(6), energy
    integer :: i, k

    do i = 1, size(nodes)
      call this%topology%get_elements_around_node(nodes(i), uses)
      this%mass(nodes(i)) = 0
      this%f(:, nodes(i)) = 0
      do k = 1, size(uses, 2)
        if (uses(1, k) > size(this%parts)) cycle
        call this%element_force(uses(1, k), corner, cauchy, energy)
        this%mass(nodes(i)) = this%mass(nodes(i)) + corner_mass(this, uses(1, k))
        this%f(:, nodes(i)) = this%f(:, nodes(i)) + corner(:, uses(2, k))
      end do
    end do
  end subroutine

  !> Faces that came free in the last step join the surface; then search, penalty and friction.
  subroutine contact_force(this, kick)
    class(code), intent(inout) :: this
    real(dp), intent(in) :: kick
    integer(int32), allocatable :: broken(:), free(:, :)
    integer :: i

    call this%cohesive%get_broken(broken)
    if (size(broken) > 0) then
      allocate (free(2, 2*size(broken)))
      do i = 1, size(broken)
        call this%topology%get_mate(broken(i), 1_int32, free(1, 2*i - 1), free(2, 2*i - 1))
        call this%topology%get_mate(broken(i), 2_int32, free(1, 2*i), free(2, 2*i))
      end do
      call this%contact%add_facets(this%topology, this%x0(:, :this%n), free, this%parts, bulk_modulus(material))
    end if
    associate (n => this%n)
      call this%contact%search(this%x(:, :n), this%v(:, :n), this%step, threads=this%threads)
      call this%contact%local_search(this%x(:, :n), this%threads)
      call this%contact%add_force(this%v(:, :n), this%mass(:n), this%f(:, :n), kick, this%threads)
    end associate
  end subroutine

  !> The last of all forces, since it is solved for with the velocities ahead.
  subroutine cohesive_force(this, kick)
    class(code), intent(inout) :: this
    real(dp), intent(in) :: kick

    associate (n => this%n)
      call this%cohesive%add_force(this%x(:, :n), this%v(:, :n), this%mass(:n), this%f(:, :n), kick, this%time, &
                                   this%threads)
    end associate
  end subroutine

  pure real(dp) function corner_mass(this, e)
    class(code), intent(in) :: this
    integer, intent(in) :: e

    corner_mass = material(this%parts(e))%density*this%volume(e)/4
  end function

  pure elemental real(dp) function lambda(m)
    type(elastic), intent(in) :: m

    lambda = m%youngs_modulus*m%poissons_ratio/((1 + m%poissons_ratio)*(1 - 2*m%poissons_ratio))
  end function

  pure elemental real(dp) function mu(m)
    type(elastic), intent(in) :: m

    mu = m%youngs_modulus/(2*(1 + m%poissons_ratio))
  end function

  pure elemental real(dp) function bulk_modulus(m)
    type(elastic), intent(in) :: m

    bulk_modulus = m%youngs_modulus/(3*(1 - 2*m%poissons_ratio))
  end function

  !> Gradients of the four shape functions, and the volume.
  pure subroutine shape_of(x, gradient, volume)
    real(dp), intent(in) :: x(3, 4)
    real(dp), intent(out) :: gradient(3, 4), volume
    real(dp) :: edge(3, 3), six

    edge = x(:, 2:4) - spread(x(:, 1), 2, 3)
    six = determinant(edge)
    gradient(:, 2) = cross(edge(:, 2), edge(:, 3))/six
    gradient(:, 3) = cross(edge(:, 3), edge(:, 1))/six
    gradient(:, 4) = cross(edge(:, 1), edge(:, 2))/six
    gradient(:, 1) = -sum(gradient(:, 2:4), dim=2)
    volume = six/6
  end subroutine

  pure function cross(a, b) result(c)
    real(dp), intent(in) :: a(3), b(3)
    real(dp) :: c(3)

    c = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
  end function

  pure real(dp) function determinant(a)
    real(dp), intent(in) :: a(3, 3)

    determinant = dot_product(a(:, 1), cross(a(:, 2), a(:, 3)))
  end function

end module plate_code
