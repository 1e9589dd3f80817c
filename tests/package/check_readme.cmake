# cmake -DREADME=<file> -DEXAMPLE=<file> -P check_readme.cmake: the README shows the example that is compiled, and what
# the host wrote for the SDK, the example and the calls elsewhere, is as short as the README says.
set(most_lines 60)
file(READ ${README} readme)
file(READ ${EXAMPLE} host)
if(NOT host MATCHES "\n// BEGIN EXAMPLE\n(.*)// END EXAMPLE")
    message(FATAL_ERROR "${EXAMPLE} marks no example")
endif()
set(example "${CMAKE_MATCH_1}")
string(FIND "${readme}" "\n```cpp\n${example}```\n" at)
if(at EQUAL -1)
    message(FATAL_ERROR "${README} does not show the example of ${EXAMPLE}")
endif()

string(REPLACE "${example}" "" elsewhere "${host}")
string(REGEX REPLACE "[][;]" "" example "${example}")   # which would bend lists
string(REGEX REPLACE "[][;]" "" elsewhere "${elsewhere}")
string(REGEX MATCHALL "\n *[^ \n/][^\n]*" lines "\n${example}")
string(REGEX MATCHALL "\n[^\n]*(restir::checkDevice|restir::deviceNeeds|restir::DeviceInfo|restir::Session|needs\\.)[^\n]*"
    calls "${elsewhere}")
list(LENGTH lines example_lines)
list(LENGTH calls other_lines)
math(EXPR sum "${example_lines} + ${other_lines}")
message(STATUS "lines written for the SDK: ${example_lines} in the example, ${other_lines} elsewhere, ${sum} in all")
if(sum GREATER most_lines)
    message(FATAL_ERROR "more than ${most_lines}")
endif()
