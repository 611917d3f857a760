/// Materials from outside: shared libraries with a law in C, C++ or Fortran, and VUMATs, loaded at run time;
/// and the compiler run that makes such a library of a source.
///
/// Whatever a library keeps for itself (COMMON, SAVE, static variables) is shared by all materials and
/// simulations of the process that name the same file.
#pragma once

#include <string>
#include <vector>

#include "cdfp/model.hpp"

namespace cdfp {

/// Sets `material.callback` to the function `symbol` (a `cdfp_material_callback`, called with no user data)
/// of a shared library. Throws `Error(io)` if the library cannot be loaded or lacks the function.
void load_material(const std::string& library, const std::string& symbol, UserMaterial& material);

struct VumatOptions {
  std::string name;               ///< cmname, in capitals as the law gets it
  bool single_precision = false;  ///< the law's reals have four bytes
  double temperature = 0;         ///< tempOld and tempNew
  std::vector<double> fields;     ///< fieldOld and fieldNew, nfieldv of them
  std::string job = "cdfp";       ///< what vgetjobname gives
  std::string folder = ".";       ///< what vgetoutdir gives
};

/// Sets `material.callback` to the subroutine VUMAT of a shared library, and `material.warnings` to what it
/// says by xplb_abqerr. Each of these forms of the interface works, told or not: nblock or jblock(*) as the
/// first argument, lanneal or jInfoArray(*) as the seventh, dt or dtArray(*) as the tenth.
///
/// - Calls come with at most 64 points, all of one integration point; ndir = nshr = 3. Elements count from 1.
/// - First call at stepTime = totalTime = 0; see `UserMaterial`.
/// - What xplb_abqerr reports as an error, xplb_exit and Fortran's STOP end the step with `Error(diverged)`;
///   the process goes on. The call is left by a long jump: files that it has open stay so, and arrays that it
///   has allocated are lost. STOP is caught in libraries of `build_material` only.
/// - Without `thread_safe` no two VUMATs of the process run at once, and one thread calls.
/// Throws `Error(io)` if the library cannot be loaded or lacks the subroutine.
void load_vumat(const std::string& library, const VumatOptions& options, UserMaterial& material);

struct BuildOptions {
  bool single_precision = false;  ///< default reals of four bytes, for Fortran
};

/// Compiles a source to a shared library: Fortran (fixed form for .f, .for and .ftn unless it says
/// !DIR$ FREEFORM, free form for .f90 and the like) with `$FC` or gfortran and the flags that VUMATs need; C
/// and C++ with `$CC` or cc, `$CXX` or c++. vaba_param.inc, SMAAspUserSubroutines.hdr and the headers of cdfp
/// are found. The library appears when it is whole. Throws `Error(bad_input)` with what the compiler said,
/// `Error(unavailable)` if there is no compiler.
void build_material(const std::string& source, const std::string& library, const BuildOptions& options = {});

/// The library of a source as it is now, compiled unless that was done before: in the folder `.cdfp` beside
/// the source, or, where that cannot be written, in the user's cache folder. Returns its path.
std::string built_material(const std::string& source, const BuildOptions& options = {});

}  // namespace cdfp
