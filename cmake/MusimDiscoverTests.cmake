# Called with PROGRAM, PREFIX, FOLDER and OUTPUT once a program of tests is linked: gives ctest each of its cases, run in FOLDER, labelled by
# its suite. The program is asked once: doctest's own script asks for the suite of each case, two minutes of a sanitized build.
execute_process(COMMAND ${PROGRAM} --list-test-cases --reporters=xml WORKING_DIRECTORY ${FOLDER} OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE "&quot;" "\"" listed "${listed}")
string(REPLACE "&lt;" "<" listed "${listed}")
string(REPLACE "&amp;" "&" listed "${listed}")
string(REGEX MATCHALL "<TestCase [^\n]*" cases "${listed}")
set(script "")
foreach(case IN LISTS cases)
  if(NOT case MATCHES "^<TestCase name=\"(.*)\" filename=")
    message(FATAL_ERROR "${PROGRAM}: no name and file of a case: ${case}")
  endif()
  set(name "${CMAKE_MATCH_1}")
  set(label "")
  if(name MATCHES "^(.*)\" testsuite=\"([^\"]*)$")
    set(name "${CMAKE_MATCH_1}")
    set(label "LABELS [==[${CMAKE_MATCH_2}]==]")
  endif()
  # a comma parts names in doctest's filter
  string(REPLACE "," "\\," filter "${name}")
  string(APPEND script "add_test([==[${PREFIX}${name}]==] [==[${PROGRAM}]==] [==[--test-case=${filter}]==])\n"
                       "set_tests_properties([==[${PREFIX}${name}]==] PROPERTIES WORKING_DIRECTORY [==[${FOLDER}]==] TIMEOUT 1800 "
                       "FAIL_REGULAR_EXPRESSION \"test cases: +0 \" ${label})\n")
endforeach()
file(WRITE ${OUTPUT} "${script}")
