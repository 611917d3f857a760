c     Elastic until the greatest direct stress passes a limit, then deleted by state 1; in the newer form of the
c     interface, with jInfoArray, dtArray and a Cray pointer to the element numbers.
c     props: E, nu, limit. states: 1 active, 2 element, 3 integration point, 4 time of all steps
      subroutine vumat(
     1  nblock, ndir, nshr, nstatev, nfieldv, nprops, jInfoArray,
     2  stepTime, totalTime, dtArray, cmname, coordMp, charLength,
     3  props, density, strainInc, relSpinInc,
     4  tempOld, stretchOld, defgradOld, fieldOld,
     5  stressOld, stateOld, enerInternOld, enerInelasOld,
     6  tempNew, stretchNew, defgradNew, fieldNew,
     7  stressNew, stateNew, enerInternNew, enerInelasNew )
      include 'vaba_param.inc'
      parameter (i_info_AnnealFlag = 1,
     *     i_info_Intpt    = 2, ! Integration station number
     *     i_info_layer  = 3, ! Layer number
     *     i_info_kspt   = 4, ! Section point number in current layer
     *     i_info_effModDefn = 5, ! =1 if Bulk/ShearMod need to be defined
     *     i_info_ElemNumStartLoc   = 6) ! Start loc of user element number
      dimension props(nprops), density(nblock), coordMp(nblock,*),
     1  charLength(nblock), dtArray(2*(nblock)+1),
     2  strainInc(nblock,ndir+nshr), relSpinInc(nblock,nshr),
     3  tempOld(nblock), stretchOld(nblock,ndir+nshr),
     4  defgradOld(nblock,ndir+nshr+nshr), fieldOld(nblock,nfieldv),
     5  stressOld(nblock,ndir+nshr), stateOld(nblock,nstatev),
     6  enerInternOld(nblock), enerInelasOld(nblock), tempNew(nblock),
     7  stretchNew(nblock,ndir+nshr),
     8  defgradNew(nblock,ndir+nshr+nshr), fieldNew(nblock,nfieldv),
     9  stressNew(nblock,ndir+nshr), stateNew(nblock,nstatev),
     1  enerInternNew(nblock), enerInelasNew(nblock), jInfoArray(*)
      character*80 cmname
      pointer (ptrjElemNum, jElemNum)
      dimension jElemNum(nblock)
      lAnneal = jInfoArray(i_info_AnnealFlag)
      intPt   = jInfoArray(i_info_Intpt)
      iUpdateEffMod = jInfoArray(i_info_effModDefn)
      iElemNumStartLoc = jInfoArray(i_info_ElemNumStartLoc)
      ptrjElemNum = loc(jInfoArray(iElemNumStartLoc))
      dt = dtArray(1)
      twomu = props(1)/(1. + props(2))
      alamda = props(2)*twomu/(1. - 2.*props(2))
      if (lAnneal .ne. 0 .or. iUpdateEffMod .ne. 0) call xplb_exit
      do k = 1, nblock
        trace = strainInc(k,1) + strainInc(k,2) + strainInc(k,3)
        do i = 1, ndir+nshr
          stressNew(k,i) = stressOld(k,i) + twomu*strainInc(k,i)
          if (i .le. ndir) stressNew(k,i) = stressNew(k,i) + alamda*trace
        end do
        stateNew(k,1) = 1
        if (max(stressNew(k,1), stressNew(k,2), stressNew(k,3))
     *     .gt. props(3) .and. totalTime .gt. 0) stateNew(k,1) = 0
        stateNew(k,2) = jElemNum(k)
        stateNew(k,3) = intPt
        stateNew(k,4) = stateOld(k,4)
        if (totalTime .gt. 0) stateNew(k,4) = stateOld(k,4) + dt
      end do
      return
      end
