# Installs the build into an empty prefix, builds tests/consumer against it and runs it on a sphere
# that the installed tools have baked.
#   cmake -DBUILD_DIR= -DSOURCE_DIR= -DWORK_DIR= -DBIN_DIR= -DGENERATOR= -DMAKE_PROGRAM=
#         -DCXX_COMPILER= -DCXX_FLAGS= -DBUILD_TYPE= -P run.cmake
cmake_minimum_required(VERSION 3.22)

# Runs a command and leaves what it says in `output`; a failure ends the test and shows it.
function(run)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE text)
    if(NOT result EQUAL 0)
        list(JOIN ARGN " " command)
        message(FATAL_ERROR "${command}\nfailed (${result}):\n${text}")
    endif()
    set(output "${text}" PARENT_SCOPE)
endfunction()

# Configures and builds a project that finds Paim in the prefix and nowhere else.
function(build_against_install source build)
    run(${CMAKE_COMMAND} -S ${source} -B ${build} -G ${GENERATOR}
        -DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM}
        -DCMAKE_CXX_COMPILER=${CXX_COMPILER}
        -DCMAKE_CXX_FLAGS=${CXX_FLAGS}
        -DCMAKE_BUILD_TYPE=${BUILD_TYPE}
        -DCMAKE_PREFIX_PATH=${prefix})
    file(STRINGS ${build}/CMakeCache.txt found REGEX "^paim_DIR:")
    string(FIND "${found}" "${prefix}/" position)
    if(position EQUAL -1)
        message(FATAL_ERROR "expected the package in ${prefix}, got ${found}")
    endif()
    run(${CMAKE_COMMAND} --build ${build})
endfunction()

# Nothing of an earlier run, or of the source tree, may help.
file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${WORK_DIR})
unset(ENV{DESTDIR})
unset(ENV{CPATH})
set(prefix ${WORK_DIR}/prefix)

run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})

# A consumer has Eigen and {fmt}, which paim::paim hands on; other libraries must stay inside.
file(GLOB_RECURSE headers ${prefix}/*.h)
foreach(header IN LISTS headers)
    file(STRINGS ${header} includes REGEX "^#include <.*/")
    list(FILTER includes EXCLUDE REGEX "<(Eigen|fmt)/")
    if(includes)
        message(FATAL_ERROR "${header}: expected Eigen and fmt only, got ${includes}")
    endif()
endforeach()

build_against_install(${SOURCE_DIR}/every_header ${WORK_DIR}/every_header)
build_against_install(${SOURCE_DIR} ${WORK_DIR}/consumer)

set(tools ${prefix}/${BIN_DIR})
run(${tools}/paim-poses sphere -o ${WORK_DIR}/poses --poses 3 --vertices 100)
run(${tools}/paim-compress ${WORK_DIR}/poses -o ${WORK_DIR}/sphere.paim
    --albedo 0.5,0.25,0.75 --bands 3 --rays 64 --transfer-components all)
run(${WORK_DIR}/consumer/paim_consumer ${WORK_DIR}/sphere.paim)
message("${output}")

# Nothing shadows a sphere, so its transfer is the closed form and the sum exact but for the
# rounding of floats, some 1e-7: far below the four digits printed.
string(FIND "${output}" "3 poses, 3 bands\nradiance 0.5000 0.2500 0.7500 to 0.5000 0.2500 0.7500\n"
    position)
if(position EQUAL -1)
    message(FATAL_ERROR "expected radiance 0.5 0.25 0.75 at every vertex, got:\n${output}")
endif()

# A file that is no .paim must end in Paim's error, thrown across the library's border.
execute_process(COMMAND ${WORK_DIR}/consumer/paim_consumer ${SOURCE_DIR}/main.cpp
    RESULT_VARIABLE result ERROR_VARIABLE message)
if(NOT result EQUAL 2 OR NOT message MATCHES "main.cpp")
    message(FATAL_ERROR "expected exit code 2 and the file's name, got ${result}: ${message}")
endif()
