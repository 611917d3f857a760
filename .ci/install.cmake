# cmake --install: command, libraries, headers, Fortran modules and their sources (module files differ from
# compiler to compiler), a CMake package with cdfp::cdfp and cdfp::fortran, and cdfp.pc for pkg-config.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(module_folder ${CMAKE_INSTALL_INCLUDEDIR}/cdfp/fortran)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/cdfp)

set_target_properties(cdfp_fortran PROPERTIES EXPORT_NAME fortran
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR})
set_target_properties(cdfp cdfp_fortran cdfp_command PROPERTIES
  INSTALL_RPATH "$ORIGIN;$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
install(TARGETS cdfp cdfp_fortran EXPORT cdfp)
install(TARGETS cdfp_command)
install(DIRECTORY include/cdfp TYPE INCLUDE)
get_property(fortran_sources GLOBAL PROPERTY CDFP_FORTRAN_SOURCES)
install(FILES ${fortran_sources} fortran_api/fpm.toml fortran_api/guide.md DESTINATION ${CMAKE_INSTALL_DATADIR}/cdfp/fortran)
foreach(source IN LISTS fortran_sources)
  get_filename_component(module ${source} NAME_WE)
  install(FILES ${CMAKE_Fortran_MODULE_DIRECTORY}/${module}.mod DESTINATION ${module_folder})
endforeach()

configure_package_config_file(.ci/cdfpConfig.cmake.in ${CMAKE_BINARY_DIR}/cdfpConfig.cmake
  INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/cdfpConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(EXPORT cdfp NAMESPACE cdfp:: FILE cdfpTargets.cmake DESTINATION ${package_folder})
install(FILES ${CMAKE_BINARY_DIR}/cdfpConfig.cmake ${CMAKE_BINARY_DIR}/cdfpConfigVersion.cmake
  DESTINATION ${package_folder})
configure_file(.ci/cdfp.pc.in ${CMAKE_BINARY_DIR}/cdfp.pc @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/cdfp.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
