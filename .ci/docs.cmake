# cmake --build BUILD --target docs: pages of the C and the Fortran door in BUILD/docs/html
find_package(Doxygen 1.9)
if(DOXYGEN_FOUND)
  get_property(modules GLOBAL PROPERTY CDFP_FORTRAN_SOURCES)
  list(FILTER modules EXCLUDE REGEX "cdfp_c(_[a-z]+)?\\.f90$")
  list(JOIN modules " " CDFP_DOCUMENTED_MODULES)
  configure_file(.ci/Doxyfile.in ${CMAKE_BINARY_DIR}/Doxyfile @ONLY)
  add_custom_target(docs COMMAND Doxygen::doxygen ${CMAKE_BINARY_DIR}/Doxyfile VERBATIM)
endif()
