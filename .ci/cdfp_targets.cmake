# How cdfp's targets are made: one object library a room, tests that link just the rooms they name.

add_library(cdfp_options INTERFACE)
target_compile_features(cdfp_options INTERFACE cxx_std_20)
target_include_directories(cdfp_options INTERFACE ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src_cpp)
target_compile_options(cdfp_options INTERFACE
  $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wshadow -Werror -fno-math-errno -fno-trapping-math>
  $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-restrict>) # GCC 12 sees overlaps in std::string that are not there
target_link_libraries(cdfp_options INTERFACE OpenMP::OpenMP_CXX)
if(CDFP_SANITIZE)
  # Of every language and program: the sanitizers' runtime has to be loaded first.
  add_compile_options(-O1 -g1 -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options(-Wno-maybe-uninitialized) # GCC loses its way among the sanitizers' branches
  endif()
endif()

# cdfp_room(NAME SOURCES a.cpp ... [LIBRARIES lib ...]): object library cdfp_NAME of the folder's sources
function(cdfp_room name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LIBRARIES")
  add_library(cdfp_${name} OBJECT ${arg_SOURCES})
  target_link_libraries(cdfp_${name} PUBLIC cdfp_options PRIVATE ${arg_LIBRARIES})
  set_property(GLOBAL APPEND PROPERTY CDFP_ROOMS cdfp_${name})
endfunction()

# Hot loops are compiled once for each instruction set and chosen at start: NAME_baseline.cpp, NAME_avx2.cpp and
# NAME_avx512.cpp; cdfp_variants(OUT NAME) lists those that this processor's family may have. Sanitizers look at
# the baseline build alone: it is the same source, and they compile it slowly.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND NOT CDFP_SANITIZE)
  target_compile_definitions(cdfp_options INTERFACE CDFP_HAS_X86_VARIANTS)
  set(CDFP_HAS_X86_VARIANTS ON)
endif()
function(cdfp_variants out name)
  set(sources ${name}_baseline.cpp)
  if(CDFP_HAS_X86_VARIANTS)
    list(APPEND sources ${name}_avx2.cpp ${name}_avx512.cpp)
    set_property(SOURCE ${name}_avx2.cpp APPEND PROPERTY COMPILE_OPTIONS -march=x86-64-v3)
    set_property(SOURCE ${name}_avx512.cpp APPEND PROPERTY COMPILE_OPTIONS -march=x86-64-v4)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      # GCC 12's own header starts "undefined" vectors with themselves.
      set_property(SOURCE ${name}_avx512.cpp APPEND PROPERTY COMPILE_OPTIONS -Wno-uninitialized -Wno-maybe-uninitialized)
    endif()
  endif()
  set(${out} ${sources} PARENT_SCOPE)
endfunction()

# cdfp_test(NAME SOURCES a.cpp ... [ROOMS core mesh ...] [LIBRARIES lib ...] [TIMEOUT s]): a GoogleTest
# executable test_NAME over the named rooms (the whole library if none is named)
function(cdfp_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "TIMEOUT" "SOURCES;ROOMS;LIBRARIES")
  add_executable(test_${name} ${arg_SOURCES})
  target_link_libraries(test_${name} PRIVATE cdfp_options GTest::gtest GTest::gtest_main ${arg_LIBRARIES})
  if(arg_ROOMS)
    foreach(room IN LISTS arg_ROOMS)
      target_link_libraries(test_${name} PRIVATE cdfp_${room})
    endforeach()
  else()
    target_link_libraries(test_${name} PRIVATE cdfp)
  endif()
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  add_test(NAME ${name} COMMAND test_${name})
  set_tests_properties(${name} PROPERTIES TIMEOUT ${arg_TIMEOUT})
endfunction()
