# cmake -D BUILD=... -D EXAMPLES=... -D COMPILER=... -D WORK=... -P check.cmake; PREFIX in place of BUILD: where musim is installed already
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})

# run(OUTPUT COMMAND...): what a command prints; a failure ends the test
function(run output)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${WORK} RESULT_VARIABLE status OUTPUT_VARIABLE printed ERROR_VARIABLE messages)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${status}\n${printed}\n${messages}")
  endif()
  set(${output} "${printed}" PARENT_SCOPE)
endfunction()

# expect(VARIABLE PATTERN): what is in brackets stands in CMAKE_MATCH_1 and so on
macro(expect variable pattern)
  if(NOT ${variable} MATCHES "${pattern}")
    message(FATAL_ERROR "expected ${pattern} in:\n${${variable}}")
  endif()
endmacro()

if(NOT PREFIX)
  set(PREFIX ${WORK}/prefix)
  run(printed ${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX})
endif()
run(printed ${CMAKE_COMMAND} -S ${EXAMPLES} -B ${WORK}/build -D CMAKE_PREFIX_PATH=${PREFIX} -D CMAKE_CXX_COMPILER=${COMPILER})
run(printed ${CMAKE_COMMAND} --build ${WORK}/build)

run(printed ${WORK}/build/own_law)
expect(printed "t 0.0016\nv 25\n")

foreach(pattern man/man1/musim-record-plot.1* bash-completion/completions/musim zsh/*/_musim doc/musim/examples/wall.json doc/musim/docs/user/*.md
                musim/musim-scene-1.schema.json musim/paraview_blocks.py)
  file(GLOB found ${PREFIX}/share/${pattern})
  if(NOT found)
    message(FATAL_ERROR "${PREFIX}/share/${pattern} is missing")
  endif()
endforeach()

run(printed ${PREFIX}/bin/musim record make pulse --frequency 0.5 --amplitude 60 --cycles 2.4 --phase 60 -o motion.csv)
run(printed ${WORK}/build/record motion.csv "0.5 s")
expect(printed "^([^:]+): peak -?[0-9.]+ g at [0-9.]+ s, PSA ([0-9.]+) m/s.2, of the model ([0-9.]+) m")
set(component ${CMAKE_MATCH_1})
if(NOT CMAKE_MATCH_2 STREQUAL CMAKE_MATCH_3)
  message(FATAL_ERROR "by Froude's law PSA is that of the prototype: ${printed}")
endif()

run(printed ${WORK}/build/tower motion.csv ${component})
expect(printed "  0.00 s +-?0.0000 m\n.*[1-9][0-9]* m\n")
