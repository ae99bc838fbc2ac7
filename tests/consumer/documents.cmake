# Takes the code blocks out of docs/embedding.md, builds them against the installed tools and runs them.
# Included by run.cmake, after play().

set(documents ${WORK_DIR}/documents)
set(page_file ${PAIM_SOURCE_DIR}/docs/embedding.md)
file(READ ${page_file} page)

# In the order of the page, so that a block that is added or moved is noticed.
set(block_files link.cmake play.cpp play.c bake.cpp)
string(REGEX MATCHALL "\n```[a-z]+\n" fences "${page}")
string(REGEX REPLACE "[\n`]" "" languages "${fences}")
if(NOT languages STREQUAL "cmake;cpp;c;cpp")
    message(FATAL_ERROR "${page_file}: expected code blocks cmake;cpp;c;cpp, got ${languages}")
endif()
set(rest "${page}")
foreach(file fence IN ZIP_LISTS block_files fences)
    string(FIND "${rest}" "${fence}" begin)
    string(LENGTH "${fence}" length)
    math(EXPR begin "${begin} + ${length}")
    string(SUBSTRING "${rest}" ${begin} -1 rest)
    string(FIND "${rest}" "\n```\n" length)
    string(SUBSTRING "${rest}" 0 ${length} block)
    file(WRITE ${documents}/${file} "${block}\n")
endforeach()
file(WRITE ${documents}/CMakeLists.txt [[
cmake_minimum_required(VERSION 3.22...3.25)
project(paim_documents LANGUAGES C CXX)
add_executable(my_program play.cpp)
include(link.cmake)
add_executable(my_c_program play.c)
target_link_libraries(my_c_program PRIVATE paim::runtime)
find_package(paim 0.1 CONFIG REQUIRED COMPONENTS tools)
add_executable(my_baker bake.cpp)
target_link_libraries(my_baker PRIVATE paim::tools)
]])

# Not optimised: building is all the time that this takes.
function(build_documents)
    set(BUILD_TYPE None)
    build_against_install(${documents} ${documents}/build)
endfunction()
build_documents()

# C++ and C print the same of a file: position and radiance of every vertex.
function(play_documents file)
    run(${documents}/build/my_program ${file})
    set(expected "${output}")
    run(${documents}/build/my_c_program ${file})
    if(NOT expected MATCHES "^[-+.0-9e]+ " OR NOT output STREQUAL expected)
        message(FATAL_ERROR "${file}: the programs of ${page_file} show\n${expected}\nand\n${output}")
    endif()
endfunction()

run(${documents}/build/my_baker ${WORK_DIR}/memory.bake ${WORK_DIR}/memory.paim)
if(NOT output MATCHES "^[0-4]\\.[0-9]+ % of error")
    message(FATAL_ERROR "${page_file}: expected an error below 5 %, got ${output}")
endif()
play_documents(${WORK_DIR}/memory.paim)

# What is no .paim is refused.
foreach(program my_program my_c_program)
    execute_process(COMMAND ${documents}/build/${program} ${page_file}
        RESULT_VARIABLE result ERROR_VARIABLE message)
    if(NOT result EQUAL 2 OR NOT message MATCHES "embedding.md")
        message(FATAL_ERROR "expected exit code 2 and the file's name, got ${result}: ${message}")
    endif()
endforeach()
