# One library per folder. `musim_module(NAME SOURCES ... PUBLIC ... PRIVATE ...)` gives it the project's language level, warnings and
# floating-point rules; what it links is what it may include.

set(MUSIM_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Wold-style-cast -Wcast-align -Wunused
    -Woverloaded-virtual -Wdouble-promotion -Wformat=2)

# What UndefinedBehaviorSanitizer checks of each pointer AddressSanitizer finds, too, but for alignment and dynamic type: without, a file
# compiles in 0.75 to 0.25 of the time (Clang 14: records/measures 8.0 s to 6.1 s, lsdem/contact/overlap_lanes.cpp 81 s to 20 s).
set(MUSIM_UNCHECKED -fno-sanitize=null,alignment,object-size,pointer-overflow,vptr)

# GCC looks for memory to free while it compiles; where it waits for a gibibyte before, it takes nine tenths of the time.
set(MUSIM_COMPILER_MEMORY $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1048576>)

# Results must be the same bits everywhere: IEEE rules stay on and no product is fused into a sum behind our back.
set(MUSIM_FLOATING_POINT -ffp-contract=off -fno-fast-math)

function(musim_compile_rules target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE ${MUSIM_WARNINGS} ${MUSIM_FLOATING_POINT} ${MUSIM_COMPILER_MEMORY}
                                           $<$<BOOL:${MUSIM_WERROR}>:-Werror> $<$<CONFIG:Release>:-O3>)
  if(MUSIM_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${MUSIM_SANITIZE} ${MUSIM_UNCHECKED} -fno-omit-frame-pointer
                                             -fno-sanitize-recover=all)
    target_link_options(${target} PUBLIC -fsanitize=${MUSIM_SANITIZE})
    target_compile_definitions(${target} PUBLIC $<BUILD_INTERFACE:MUSIM_CONTRACTS=1>)
  endif()
  # accesses to containers, and contracts (lsdem/contract.hpp)
  target_compile_definitions(${target} PUBLIC $<$<CONFIG:Debug>:_GLIBCXX_ASSERTIONS=1>
                                              $<BUILD_INTERFACE:$<$<CONFIG:Debug>:MUSIM_CONTRACTS=1>>)
endfunction()

# For code made of JSON and text, whose speed nobody waits for: GCC compiles it at -Og in two thirds of the time of -O2. Sanitized, Clang
# compiles it at -O0 in half the time of -O1 (cli/lsdem/pair.cpp 15 s, not 29 s; fewer checks save nothing).
function(musim_compile_quickly target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-Og>)
  if(MUSIM_SANITIZE)
    target_compile_options(${target} PRIVATE -O0)
  endif()
endfunction()

# But for files of theirs that calculate, on which users and sanitized tests would wait.
function(musim_calculate)
  if(MUSIM_SANITIZE)
    set(level -O2)
  else()
    set(level $<$<CONFIG:Release>:-O3>)
  endif()
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS ${level} SKIP_PRECOMPILE_HEADERS ON)
endfunction()

# Compiles headers that most files of a target include once, with what the standard library always brings: half of the time of a full build.
# Files still include what they use; MUSIM_PRECOMPILED=OFF builds without.
function(musim_precompile target)
  if(MUSIM_PRECOMPILED)
    target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <filesystem> <functional> <memory> <optional> <span> <string>
                                                <string_view> <vector> ${ARGN})
  endif()
endfunction()

# Compiles the files of a target several at a time: most of the time goes into the same templates in every file. Names that only one file
# knows must then differ within a target. MUSIM_UNITY=OFF builds file by file. With 40 files GCC takes 0.7 to 0.8 of the time of 16, or of a
# folder at a time (lsdem/study 110 s to 78 s, scaling and records 171 s to 133 s).
function(musim_unite target)
  if(MUSIM_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 40)
  endif()
endfunction()

# For scenes, results, runs, studies and pages: JSON in most files, the same headers in all.
function(musim_json_rules target)
  musim_compile_quickly(${target})
  if(MUSIM_PRECOMPILED AND NOT target STREQUAL musim_lsdem_scene)
    target_precompile_headers(${target} REUSE_FROM musim_lsdem_scene)
  else()
    musim_precompile(${target} <Eigen/Core> <Eigen/Geometry> <fmt/format.h> <nlohmann/json.hpp> "${PROJECT_SOURCE_DIR}/scaling/units.hpp")
  endif()
  musim_unite(${target})
endfunction()

function(musim_module name)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(musim_${name} STATIC ${arg_SOURCES})
  add_library(musim::${name} ALIAS musim_${name})
  set_target_properties(musim_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(musim_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/musim>)
  target_link_libraries(musim_${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  musim_compile_rules(musim_${name})
  set_property(GLOBAL APPEND PROPERTY MUSIM_MODULES musim_${name})
endfunction()
