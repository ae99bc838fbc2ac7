# Builds Paim's shared runtime where the tools' libraries are not to be found, installs it, checks what it
# shows, and builds the programs of tests/consumer/runtime against it. Included by run.cmake.

set(without_tools -DPAIM_BUILD_TOOLS=OFF -DPAIM_BUILD_PLAYER=OFF -DPAIM_BUILD_TESTS=OFF -DPAIM_BUILD_BENCHMARKS=OFF)
foreach(package OpenEXR TBB embree CLI11 PkgConfig GTest benchmark glfw3)
    list(APPEND without_tools -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()

# The sanitizers' own functions come from the program.
set(no_undefined "-Wl,--no-undefined")
if(CXX_FLAGS MATCHES "-fsanitize")
    set(no_undefined "")
endif()

# Not optimised, which builds fastest and leaves the most symbols that could be visible by mistake. The
# results are the same: they depend on neither compiler options nor the number of threads.
run(${CMAKE_COMMAND} -S ${PAIM_SOURCE_DIR} -B ${WORK_DIR}/runtime_only -G ${GENERATOR}
    -DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM}
    -DCMAKE_CXX_COMPILER=${CXX_COMPILER}
    -DCMAKE_CXX_COMPILER_LAUNCHER=${CXX_COMPILER_LAUNCHER}
    -DCMAKE_CXX_FLAGS=${CXX_FLAGS}
    -DCMAKE_BUILD_TYPE=None
    -DBUILD_SHARED_LIBS=ON
    -DCMAKE_UNITY_BUILD=ON
    -DCMAKE_SHARED_LINKER_FLAGS=${no_undefined}
    ${without_tools})
file(STRINGS ${WORK_DIR}/runtime_only/CMakeCache.txt searched REGEX "^STB_INCLUDE_DIR")
if(searched)
    message(FATAL_ERROR "expected no search for stb, got ${searched}")
endif()
run(${CMAKE_COMMAND} --build ${WORK_DIR}/runtime_only)
set(prefix ${WORK_DIR}/shared)
run(${CMAKE_COMMAND} --install ${WORK_DIR}/runtime_only --prefix ${prefix})
file(GLOB_RECURSE library ${prefix}/*/libpaim_runtime.so)
file(GLOB_RECURSE archives ${prefix}/*.a)
if(NOT library OR archives)
    message(FATAL_ERROR "expected libpaim_runtime.so and no archive, got '${library}' and '${archives}'")
endif()

# What installed headers mark PAIM_EXPORT: functions of C, and functions and classes of C++.
set(c_names)
set(cpp_names)
file(GLOB_RECURSE headers ${prefix}/include/*.h)
foreach(header IN LISTS headers)
    file(READ ${header} text)
    string(REGEX MATCHALL "PAIM_EXPORT [^({;]*[({;]" marked "${text}")
    foreach(declaration IN LISTS marked)
        if(declaration MATCHES "(paim_[a-z_]+)\\($")
            list(APPEND c_names ${CMAKE_MATCH_1})
        elseif(declaration MATCHES "([a-z_]+)\\($")
            list(APPEND cpp_names ${CMAKE_MATCH_1})
        elseif(declaration MATCHES "^PAIM_EXPORT ([A-Za-z]+)")
            list(APPEND cpp_names ${CMAKE_MATCH_1})
        endif()
    endforeach()
endforeach()
list(JOIN cpp_names "|" cpp_names)

# The library shows all of the C functions, and nothing that is not marked.
run(${NM} -D --defined-only --demangle ${library})
string(REGEX REPLACE "\n$" "" output "${output}")
string(REPLACE ";" " " output "${output}")
string(REPLACE "\n" ";" symbols "${output}")
set(unmarked)
foreach(symbol IN LISTS symbols)
    string(REGEX REPLACE "^[0-9a-f]+ [A-Za-z] " "" name "${symbol}")
    if(name IN_LIST c_names)
        list(REMOVE_ITEM c_names ${name})
    elseif(NOT name MATCHES "^((typeinfo|typeinfo name|vtable) for )?paim::(detail::)?(${cpp_names})(::|\\(|\\[|$)")
        list(APPEND unmarked "${symbol}")
    endif()
endforeach()
if(unmarked OR c_names)
    list(JOIN unmarked "\n" unmarked)
    message(FATAL_ERROR "${library}: expected PAIM_EXPORT alone and all of paim.h, got\n${unmarked}\nwithout ${c_names}")
endif()

build_against_install(${SOURCE_DIR}/runtime ${WORK_DIR}/build_shared)
find_program(LDD ldd)
if(LDD)
    run(${LDD} ${WORK_DIR}/build_shared/paim_play_c)
    string(FIND "${output}" "${prefix}/" position)
    if(position EQUAL -1)
        message(FATAL_ERROR "expected the library in ${prefix}, got ${output}")
    endif()
endif()

# The tools are not there, and their absence is what find_package says.
file(WRITE ${WORK_DIR}/no_tools/CMakeLists.txt
    "cmake_minimum_required(VERSION 3.22)\nproject(x CXX)\nfind_package(paim CONFIG REQUIRED COMPONENTS tools)\n")
execute_process(COMMAND ${CMAKE_COMMAND} -S ${WORK_DIR}/no_tools -B ${WORK_DIR}/no_tools/build -G ${GENERATOR}
        -DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM} -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_PREFIX_PATH=${prefix}
    RESULT_VARIABLE result OUTPUT_VARIABLE message ERROR_VARIABLE message)
if(result EQUAL 0 OR NOT message MATCHES "component[ \n]+runtime,[ \n]+but[ \n]+not[ \n]+tools")
    message(FATAL_ERROR "expected find_package to say that tools are not installed, got ${result}: ${message}")
endif()
