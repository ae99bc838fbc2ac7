# Flags every target of ours gets; dependencies never see them.
add_library(paim_flags INTERFACE)
target_compile_features(paim_flags INTERFACE cxx_std_20)
# No contraction to fused multiply-add: the same bytes come out on every x86-64 and Arm machine.
target_compile_options(paim_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
    -fno-math-errno -ffp-contract=off)
if(PAIM_WARNINGS_AS_ERRORS)
    target_compile_options(paim_flags INTERFACE -Werror)
endif()
if(PAIM_SANITIZE)
    target_compile_options(paim_flags INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer
        -fno-sanitize-recover=undefined)
    target_link_options(paim_flags INTERFACE -fsanitize=address,undefined)
endif()

# paim_add_tool(NAME SOURCES... LIBRARIES...): an installed command-line tool.
function(paim_add_tool name)
    cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
    add_executable(${name} ${ARG_SOURCES})
    target_link_libraries(${name} PRIVATE paim_flags ${ARG_LIBRARIES})
    set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
    if(BUILD_SHARED_LIBS)
        # An installed tool finds the library by its relative path, wherever the prefix is moved.
        file(RELATIVE_PATH library_dir ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
        set_target_properties(${name} PROPERTIES INSTALL_RPATH "$ORIGIN/${library_dir}")
    endif()
    install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()
