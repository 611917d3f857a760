c     Elastic, in single precision, with the element numbers that jblock brings.
c     props: E, nu. states: 1 element, 2 integration point, 3 bytes of a real
      subroutine vumat(
     1  jblock, ndir, nshr, nstatev, nfieldv, nprops, lanneal,
     2  stepTime, totalTime, dt, cmname, coordMp, charLength,
     3  props, density, strainInc, relSpinInc,
     4  tempOld, stretchOld, defgradOld, fieldOld,
     5  stressOld, stateOld, enerInternOld, enerInelasOld,
     6  tempNew, stretchNew, defgradNew, fieldNew,
     7  stressNew, stateNew, enerInternNew, enerInelasNew )
      include 'vaba_param.inc'
      dimension jblock(*), props(nprops), density(*), coordMp(*),
     1  charLength(*), strainInc(*), relSpinInc(*), tempOld(*),
     2  stretchOld(*), defgradOld(*), fieldOld(*), stressOld(*),
     3  stateOld(*), enerInternOld(*), enerInelasOld(*), tempNew(*),
     4  stretchNew(*), defgradNew(*), fieldNew(*), stressNew(*),
     5  stateNew(*), enerInternNew(*), enerInelasNew(*)
      character*80 cmname
      parameter (i_umt_nblock = 1, i_umt_npt = 2, i_umt_layer = 3,
     1  i_umt_kspt = 4, i_umt_noel = 5)
      call vumatXtrArg(jblock(i_umt_nblock),
     1  ndir, nshr, nstatev, nprops, props, strainInc, stressOld,
     2  stressNew, stateNew,
     3  jblock(i_umt_noel), jblock(i_umt_npt))
      return
      end

      subroutine vumatXtrArg(nblock, ndir, nshr, nstatev, nprops, props,
     1  strainInc, stressOld, stressNew, stateNew, nElement, nMatPoint)
      include 'vaba_param.inc'
      dimension props(nprops), strainInc(nblock,ndir+nshr),
     1  stressOld(nblock,ndir+nshr), stressNew(nblock,ndir+nshr),
     2  stateNew(nblock,nstatev), nElement(nblock)
      twomu = props(1)/(1. + props(2))
      alamda = props(2)*twomu/(1. - 2.*props(2))
      do k = 1, nblock
        trace = strainInc(k,1) + strainInc(k,2) + strainInc(k,3)
        do i = 1, ndir
          stressNew(k,i) = stressOld(k,i) + twomu*strainInc(k,i)
     1      + alamda*trace
        end do
        do i = ndir+1, ndir+nshr
          stressNew(k,i) = stressOld(k,i) + twomu*strainInc(k,i)
        end do
        stateNew(k,1) = nElement(k)
        stateNew(k,2) = nMatPoint
        stateNew(k,3) = kind(trace)
      end do
      return
      end
