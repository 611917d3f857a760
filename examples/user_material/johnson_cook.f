c     Johnson-Cook plasticity with adiabatic heating, a VUMAT as for Abaqus/Explicit.
c
c     yield = (A + B ep**n) (1 + C ln(max(1, rate/rate0))) (1 - T***m),  T* = (T - Troom) / (Tmelt - Troom)
c
c     props: 1 E, 2 nu, 3 A, 4 B, 5 n, 6 C, 7 rate0, 8 m, 9 Troom, 10 Tmelt, 11 heat capacity (J/kg K),
c            12 share of the plastic work that becomes heat, 13 plastic strain at failure
c     states: 1 plastic strain, 2 temperature, 3 yield stress, 4 intact: 1, failed: 0
      subroutine vumat(
     1  nblock, ndir, nshr, nstatev, nfieldv, nprops, lanneal,
     2  stepTime, totalTime, dt, cmname, coordMp, charLength,
     3  props, density, strainInc, relSpinInc,
     4  tempOld, stretchOld, defgradOld, fieldOld,
     5  stressOld, stateOld, enerInternOld, enerInelasOld,
     6  tempNew, stretchNew, defgradNew, fieldNew,
     7  stressNew, stateNew, enerInternNew, enerInelasNew )
      include 'vaba_param.inc'
      dimension props(nprops), density(nblock), coordMp(nblock,*),
     1  charLength(nblock), strainInc(nblock,ndir+nshr),
     2  relSpinInc(nblock,nshr), tempOld(nblock),
     3  stretchOld(nblock,ndir+nshr),
     4  defgradOld(nblock,ndir+nshr+nshr),
     5  fieldOld(nblock,nfieldv), stressOld(nblock,ndir+nshr),
     6  stateOld(nblock,nstatev), enerInternOld(nblock),
     7  enerInelasOld(nblock), tempNew(nblock),
     8  stretchNew(nblock,ndir+nshr),
     9  defgradNew(nblock,ndir+nshr+nshr),
     1  fieldNew(nblock,nfieldv),
     2  stressNew(nblock,ndir+nshr), stateNew(nblock,nstatev),
     3  enerInternNew(nblock), enerInelasNew(nblock)
      character*80 cmname
      dimension s(6)
      parameter (zero = 0.d0, one = 1.d0, two = 2.d0, three = 3.d0,
     1  third = one/three, half = 0.5d0, most = 60, tol = 1.d-10)

      e = props(1)
      xnu = props(2)
      twomu = e/(one + xnu)
      bulk = third*e/(one - two*xnu)

      do 100 k = 1, nblock
        ep = stateOld(k,1)
        temp = stateOld(k,2)
        if (totalTime .eq. zero) temp = props(9)
        intact = 1
        if (totalTime .gt. zero .and. stateOld(k,4) .eq. zero) intact = 0

c       elastic trial
        volume = strainInc(k,1) + strainInc(k,2) + strainInc(k,3)
        press = third*(stressOld(k,1) + stressOld(k,2) + stressOld(k,3))
     1    + bulk*volume
        do 10 i = 1, 6
          s(i) = stressOld(k,i) + twomu*strainInc(k,i)
          if (i .le. 3) s(i) = s(i) - press + (bulk - third*twomu)*volume
   10   continue
        equiv = sqrt(1.5d0*(s(1)**2 + s(2)**2 + s(3)**2)
     1    + three*(s(4)**2 + s(5)**2 + s(6)**2))

        dep = zero
        call kyield(props, nprops, ep, zero, dt, temp, yield)
        if (equiv .gt. yield .and. totalTime .gt. zero) then
c         equiv - 3 mu dep = yield(dep, its rate and its heat), by bisection and secant in turn
          low = 0
          a = zero
          b = equiv/(1.5d0*twomu)
          do 20 it = 1, most
            dep = half*(a + b)
            call kheat(props, nprops, equiv, twomu, dep, density(k),
     1        temp, hot)
            call kyield(props, nprops, ep + dep, dep, dt, hot, yield)
            if (equiv - 1.5d0*twomu*dep .gt. yield) then
              a = dep
            else
              b = dep
            end if
            if (b - a .lt. tol*b) goto 30
   20     continue
   30     continue
          temp = hot
        end if

        scale = one
        if (equiv .gt. zero) scale = one - 1.5d0*twomu*dep/equiv
        if (ep + dep .gt. props(13)) intact = 0
        work = zero
        do 40 i = 1, 6
          stressNew(k,i) = scale*s(i)
          if (i .le. 3) stressNew(k,i) = stressNew(k,i) + press
          share = one
          if (i .gt. 3) share = two
          work = work + share*half*(stressOld(k,i) + stressNew(k,i))
     1      *strainInc(k,i)
   40   continue
        stateNew(k,1) = ep + dep
        stateNew(k,2) = temp
        stateNew(k,3) = yield
        stateNew(k,4) = intact
        enerInternNew(k) = enerInternOld(k) + work/density(k)
        enerInelasNew(k) = enerInelasOld(k)
     1    + scale*equiv*dep/density(k)
  100 continue
      return
      end

      subroutine kyield(props, nprops, ep, dep, dt, temp, yield)
      include 'vaba_param.inc'
      dimension props(nprops)
      yield = props(3)
      if (ep .gt. 0.d0) yield = yield + props(4)*ep**props(5)
      rate = dep/dt/props(7)
      if (rate .gt. 1.d0) yield = yield*(1.d0 + props(6)*log(rate))
      hot = (temp - props(9))/(props(10) - props(9))
      if (hot .ge. 1.d0) yield = 0.d0
      if (hot .gt. 0.d0 .and. hot .lt. 1.d0)
     1  yield = yield*(1.d0 - hot**props(8))
      return
      end

      subroutine kheat(props, nprops, equiv, twomu, dep, density,
     1  temp, hot)
      include 'vaba_param.inc'
      dimension props(nprops)
      work = (equiv - 1.5d0*twomu*dep)*dep
      hot = temp + props(12)*work/(density*props(11))
      return
      end
