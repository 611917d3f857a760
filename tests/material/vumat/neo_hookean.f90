! Compressible neo-Hookean solid from the stretch: s = mu / J (U^2 - 1) + lambda ln J / J.
! props: lambda, mu. One state: J.
subroutine vumat(nblock, ndir, nshr, nstatev, nfieldv, nprops, lanneal, stepTime, totalTime, dt, cmname, coordMp, &
                 charLength, props, density, strainInc, relSpinInc, tempOld, stretchOld, defgradOld, fieldOld, &
                 stressOld, stateOld, enerInternOld, enerInelasOld, tempNew, stretchNew, defgradNew, fieldNew, &
                 stressNew, stateNew, enerInternNew, enerInelasNew)
  implicit none
  integer, intent(in) :: nblock, ndir, nshr, nstatev, nfieldv, nprops, lanneal
  real, intent(in) :: stepTime, totalTime, dt
  character(len=80), intent(in) :: cmname
  real, intent(in) :: coordMp(nblock, *), charLength(nblock), props(nprops), density(nblock)
  real, intent(in), dimension(nblock, ndir + nshr) :: strainInc, stretchOld, stretchNew, stressOld
  real, intent(in) :: relSpinInc(nblock, nshr), tempOld(nblock), tempNew(nblock)
  real, intent(in), dimension(nblock, ndir + 2*nshr) :: defgradOld, defgradNew
  real, intent(in) :: fieldOld(nblock, nfieldv), fieldNew(nblock, nfieldv), stateOld(nblock, nstatev)
  real, intent(in) :: enerInternOld(nblock), enerInelasOld(nblock)
  real, intent(out) :: stressNew(nblock, ndir + nshr), stateNew(nblock, nstatev)
  real, intent(out) :: enerInternNew(nblock), enerInelasNew(nblock)
  integer :: k
  real :: u(3, 3), b(3, 3), f(3, 3), j, invariant

  do k = 1, nblock
    u(1, :) = [stretchNew(k, 1), stretchNew(k, 4), stretchNew(k, 6)]
    u(2, :) = [stretchNew(k, 4), stretchNew(k, 2), stretchNew(k, 5)]
    u(3, :) = [stretchNew(k, 6), stretchNew(k, 5), stretchNew(k, 3)]
    f(1, :) = [defgradNew(k, 1), defgradNew(k, 4), defgradNew(k, 9)]
    f(2, :) = [defgradNew(k, 7), defgradNew(k, 2), defgradNew(k, 5)]
    f(3, :) = [defgradNew(k, 6), defgradNew(k, 8), defgradNew(k, 3)]
    b = matmul(u, u)
    j = f(1, 1)*(f(2, 2)*f(3, 3) - f(2, 3)*f(3, 2)) - f(1, 2)*(f(2, 1)*f(3, 3) - f(2, 3)*f(3, 1)) &
      + f(1, 3)*(f(2, 1)*f(3, 2) - f(2, 2)*f(3, 1))
    invariant = b(1, 1) + b(2, 2) + b(3, 3)
    stressNew(k, 1:3) = (props(2)*([b(1, 1), b(2, 2), b(3, 3)] - 1) + props(1)*log(j))/j
    stressNew(k, 4:6) = props(2)*[b(1, 2), b(2, 3), b(3, 1)]/j
    stateNew(k, 1) = j
    enerInternNew(k) = (props(2)/2*(invariant - 3 - 2*log(j)) + props(1)/2*log(j)**2)/(density(k)*j)
    enerInelasNew(k) = 0
  end do
end subroutine vumat
