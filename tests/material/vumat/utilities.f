c     Every utility routine that cdfp has, and what goes wrong in user subroutines, by props(3):
c     1 xplb_exit, 2 STOP, 3 an error that stops, 4 an error that goes on, 5 states written past the end,
c     6 not a number, 7 stress written past the end, 8 call exit
      subroutine vumat(
     1  nblock, ndir, nshr, nstatev, nfieldv, nprops, lanneal,
     2  stepTime, totalTime, dt, cmname, coordMp, charLength,
     3  props, density, strainInc, relSpinInc,
     4  tempOld, stretchOld, defgradOld, fieldOld,
     5  stressOld, stateOld, enerInternOld, enerInelasOld,
     6  tempNew, stretchNew, defgradNew, fieldNew,
     7  stressNew, stateNew, enerInternNew, enerInelasNew )
      include 'vaba_param.inc'
#include <SMAAspUserSubroutines.hdr>
      dimension props(nprops), density(nblock),
     1  strainInc(nblock,ndir+nshr), stressOld(nblock,ndir+nshr),
     2  stateOld(nblock,nstatev), stressNew(nblock,ndir+nshr),
     3  stateNew(nblock,nstatev)
      character*80 cmname
      character*256 job, folder
      dimension intv(2), realv(2)
      character*8 charv(2)
      dimension rdata(136*6), jdata(136*6)
      character*3 cdata(136*6)
      dimension shared(10), own(5), ncount(3)
      pointer (ptrs, shared), (ptro, own), (ptrn, ncount)

      call vgetjobname(job, ljob)
      call vgetoutdir(folder, lfolder)
      call vgetrank(irank)
      call vgetnumcpus(ncpus)
      call vgetinternal('PART-1', 7, 1, internal, jrcd)
      call MutexInit(1)
      call MutexLock(1)
      ptrs = SMAFloatArrayAccess(11)
      if (ptrs .eq. 0) ptrs = SMAFloatArrayCreate(11, 10, -2.5)
      shared(1) = shared(1) + 1
      ptro = SMALocalFloatArrayCreate(11, 5)
      ptrn = SMAIntArrayAccess(3)
      ncount(3) = ncount(3) + 1
      call MutexUnlock(1)
      jStatus = 1
      call vgetvrm('S', rdata, jdata, cdata, jStatus)
      call vgetvrm('PEEQ', rdata, jdata, cdata, jMissing)

      twomu = props(1)/(1. + props(2))
      alamda = props(2)*twomu/(1. - 2.*props(2))
      do k = 1, nblock
        trace = strainInc(k,1) + strainInc(k,2) + strainInc(k,3)
        do i = 1, ndir+nshr
          stressNew(k,i) = stressOld(k,i) + twomu*strainInc(k,i)
          if (i .le. ndir) stressNew(k,i) = stressNew(k,i)+alamda*trace
        end do
        stateNew(k,1) = ljob
        stateNew(k,2) = shared(1)
        stateNew(k,3) = shared(10)
        stateNew(k,4) = own(5) + 10*SMALocalFloatArraySize(11)
        stateNew(k,5) = ncount(3)
        stateNew(k,6) = rdata(k) - stressOld(k,1) + jStatus
        stateNew(k,7) = jMissing
        stateNew(k,8) = internal + ncpus + 10*irank + jrcd
        stateNew(k,9) = getnumthreads() + get_thread_id()
        stateNew(k,10) = ichar(job(1:1)) - ichar(folder(1:1))
      end do
      call SMALocalFloatArrayDelete(11)
      if (totalTime .eq. 0) return
      intv(1) = 42
      realv(1) = 2.5
      charv(1) = 'soft'
      call xplb_abqerr(-1, 'block %I of %S at %R', intv, realv, charv)
      mode = int(props(3))
      if (mode .eq. 1) then
        call MutexLock(2)
        call xplb_exit
      end if
      if (mode .eq. 2) stop 'the table ends'
      if (mode .eq. 3) call xplb_abqerr(-3, 'wrong %S', 0, 0., 'moduli')
      if (mode .eq. 4) call xplb_abqerr(-2, 'bad value %R', 0, props(1),' ')
      if (mode .eq. 5) call kspoil(stateNew, nblock*nstatev + 1)
      if (mode .eq. 6) stressNew(1,4) = log(props(2) - 10)
      if (mode .eq. 7) call kspoil(stressNew, nblock*(ndir+nshr) + 1)
      if (mode .eq. 8) call exit(3)
      call MutexLock(2)
      call MutexUnlock(2)
      return
      end

      subroutine kspoil(array, n)
      include 'vaba_param.inc'
      dimension array(*)
      array(n) = 1
      return
      end

      subroutine vexternaldb(lOp, i_Array, niArray, r_Array, nrArray)
      include 'vaba_param.inc'
#include <SMAAspUserSubroutines.hdr>
      dimension i_Array(niArray), r_Array(nrArray), ncount(3)
      pointer (ptrn, ncount)
      if (lOp .eq. 0) ptrn = SMAIntArrayCreate(3, 3, 100)
      return
      end
