# Installs the build into empty prefixes, builds the programs of tests/consumer and of docs/embedding.md
# against them and runs those of tests/consumer on every codec, precision and prefix that the installed
# tools write. These also run against a shared runtime that is built without the tools' libraries.
#   cmake -DBUILD_DIR= -DPAIM_SOURCE_DIR= -DSOURCE_DIR= -DWORK_DIR= -DBIN_DIR= -DGENERATOR= -DMAKE_PROGRAM=
#         -DCXX_COMPILER= -DCXX_COMPILER_LAUNCHER= -DNM= -DCXX_FLAGS= -DBUILD_TYPE= -P run.cmake
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
        -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_C_FLAGS=${CXX_FLAGS})
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

# The runtime alone: few headers, which include the standard library, Eigen and each other.
set(prefix ${WORK_DIR}/runtime)
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix} --component runtime)
file(GLOB_RECURSE headers ${prefix}/*.h)
list(LENGTH headers num_headers)
if(num_headers GREATER 20 OR num_headers EQUAL 0)
    message(FATAL_ERROR "expected 1 to 20 headers of the runtime, got ${num_headers}: ${headers}")
endif()
foreach(header IN LISTS headers)
    file(STRINGS ${header} includes REGEX "^#include [<\"].*/")
    list(FILTER includes EXCLUDE REGEX "[<\"](Eigen|paim)/")
    if(includes)
        message(FATAL_ERROR "${header}: expected Eigen and paim only, got ${includes}")
    endif()
endforeach()
file(GLOB_RECURSE targets ${prefix}/*runtime-targets.cmake)
file(STRINGS ${targets} links REGEX "INTERFACE_LINK_LIBRARIES")
string(REGEX MATCHALL "[A-Za-z0-9_]+::[A-Za-z0-9_]+" libraries "${links}")
list(REMOVE_ITEM libraries Eigen3::Eigen zstd::zstd meshoptimizer::meshoptimizer)
if(libraries OR NOT links)
    message(FATAL_ERROR "expected Eigen's headers, zstd and meshoptimizer, got ${links}")
endif()
build_against_install(${SOURCE_DIR}/runtime ${WORK_DIR}/build_runtime)
find_program(LDD ldd)
if(LDD AND NOT CXX_FLAGS MATCHES "sanitize")
    run(${LDD} ${WORK_DIR}/build_runtime/paim_play_cpp)
    string(REGEX MATCHALL "lib[a-z_A-Z+]+[-.]" loaded "${output}")
    list(REMOVE_DUPLICATES loaded)
    list(FILTER loaded EXCLUDE REGEX "^lib(zstd|meshoptimizer|stdc\\+\\+|m|gcc_s|c|pthread|dl|paim_runtime)[-.]$")
    if(loaded)
        message(FATAL_ERROR "expected no library but zstd, meshoptimizer and the C++ runtime, got ${loaded}")
    endif()
endif()

include(${CMAKE_CURRENT_LIST_DIR}/runtime_only.cmake)

# Everything.
set(prefix ${WORK_DIR}/all)
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})
set(tools ${prefix}/${BIN_DIR})

# C++ and C, with the static runtime and with the shared one.
set(programs
    ${WORK_DIR}/build_runtime/paim_play_cpp ${WORK_DIR}/build_runtime/paim_play_c
    ${WORK_DIR}/build_shared/paim_play_cpp ${WORK_DIR}/build_shared/paim_play_c)

# Plays a file with all programs, which have to agree; leaves what they print in `output`.
function(play file)
    unset(expected)
    foreach(program IN LISTS programs)
        run(${program} ${ARGN} ${file})
        if(NOT DEFINED expected)
            set(expected "${output}")
        elseif(NOT output STREQUAL expected)
            message(FATAL_ERROR "${file}: the first program shows\n${expected}\n${program} shows\n${output}")
        endif()
    endforeach()
    set(output "${output}" PARENT_SCOPE)
endfunction()

# Cuts the file to each size that can be played, and one byte less than the smallest.
function(play_prefixes file)
    run(${tools}/paim-info ${file} --prefixes --json)
    string(JSON num_prefixes LENGTH "${output}" prefixes)
    set(json "${output}")
    math(EXPR last "${num_prefixes} - 1")
    foreach(j RANGE ${last})
        string(JSON size GET "${json}" prefixes ${j} size_bytes)
        execute_process(COMMAND head -c ${size} ${file} OUTPUT_FILE ${WORK_DIR}/prefix.paim)
        play(${WORK_DIR}/prefix.paim --prefix)
    endforeach()
    string(JSON size GET "${json}" prefixes 0 size_bytes)
    math(EXPR size "${size} - 1")
    execute_process(COMMAND head -c ${size} ${file} OUTPUT_FILE ${WORK_DIR}/prefix.paim)
    foreach(program IN LISTS programs)
        execute_process(COMMAND ${program} --prefix ${WORK_DIR}/prefix.paim
            RESULT_VARIABLE result ERROR_VARIABLE message)
        if(NOT result EQUAL 2 OR NOT message MATCHES "cut short")
            message(FATAL_ERROR "${program}: expected exit code 2 and 'cut short', got ${result}: ${message}")
        endif()
    endforeach()
endfunction()

# Nothing shadows a sphere, so its transfer is the closed form and the sum exact but for the
# rounding of floats, some 1e-7: far below the four digits printed.
run(${tools}/paim-poses sphere -o ${WORK_DIR}/poses --poses 3 --vertices 100)
run(${tools}/paim-compress ${WORK_DIR}/poses -o ${WORK_DIR}/sphere.paim
    --albedo 0.5,0.25,0.75 --bands 3 --rays 64 --transfer-components all)
play(${WORK_DIR}/sphere.paim)
message("${output}")
string(FIND "${output}" "3 poses, 3 bands\nradiance 0.5000 0.2500 0.7500 to 0.5000 0.2500 0.7500\n"
    position)
if(position EQUAL -1)
    message(FATAL_ERROR "expected radiance 0.5 0.25 0.75 at every vertex, got:\n${output}")
endif()

# Every codec and precision, with and without a still mesh, whole and as prefixes.
run(${tools}/paim-poses octopus -o ${WORK_DIR}/octopus --poses 4 --vertices 1000)
file(GLOB still ${WORK_DIR}/poses/*.obj)
list(GET still 0 still)
run(${tools}/paim-compress bake ${WORK_DIR}/octopus -o ${WORK_DIR}/alone.bake --bands 3 --rays 64)
run(${tools}/paim-compress bake ${WORK_DIR}/octopus -o ${WORK_DIR}/among.bake --bands 3 --rays 64
    --static ${still})
set(settings
    "--max-error 10%"
    "--max-error 10% --codec svd"
    "--max-error 10% --codec cpca"
    "--max-error 10% --precision f32"
    "--max-error 10% --precision f16"
    "--max-size 40K"
    "--transfer-components 2 --geometry-components 2 --precision f16"
    "--transfer-components all --geometry-components all"
    "--measure")
foreach(bake alone among)
    foreach(setting IN LISTS settings)
        separate_arguments(arguments UNIX_COMMAND "${setting}")
        run(${tools}/paim-compress encode ${WORK_DIR}/${bake}.bake -o ${WORK_DIR}/x.paim ${arguments})
        play(${WORK_DIR}/x.paim)
        play_prefixes(${WORK_DIR}/x.paim)
    endforeach()
endforeach()

# The programs of the documents: one bakes and encodes from memory, the others play.
include(${CMAKE_CURRENT_LIST_DIR}/documents.cmake)
play(${WORK_DIR}/memory.paim)
play_documents(${WORK_DIR}/x.paim)

# A file that is no .paim must end in Paim's error, thrown across the library's border.
foreach(program IN LISTS programs)
    execute_process(COMMAND ${program} ${CMAKE_CURRENT_LIST_FILE}
        RESULT_VARIABLE result ERROR_VARIABLE message)
    if(NOT result EQUAL 2 OR NOT message MATCHES "run.cmake")
        message(FATAL_ERROR "expected exit code 2 and the file's name, got ${result}: ${message}")
    endif()
endforeach()
