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
