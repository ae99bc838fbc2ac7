# The install as others see it. Sanitized code needs its flags in the consumer too.
set(consumer_flags ${CMAKE_CXX_FLAGS})
if(PAIM_SANITIZE)
    string(APPEND consumer_flags " -fsanitize=address,undefined")
endif()
add_test(NAME consumer
    COMMAND ${CMAKE_COMMAND}
        -DBUILD_DIR=${PROJECT_BINARY_DIR}
        -DPAIM_SOURCE_DIR=${PROJECT_SOURCE_DIR}
        -DSOURCE_DIR=${CMAKE_CURRENT_LIST_DIR}
        -DWORK_DIR=${CMAKE_CURRENT_BINARY_DIR}/consumer
        -DBIN_DIR=${CMAKE_INSTALL_BINDIR}
        -DGENERATOR=${CMAKE_GENERATOR}
        -DMAKE_PROGRAM=${CMAKE_MAKE_PROGRAM}
        -DCXX_COMPILER=${CMAKE_CXX_COMPILER}
        -DCXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}
        -DNM=${CMAKE_NM}
        -DCXX_FLAGS=${consumer_flags}
        -DBUILD_TYPE=$<CONFIG>
        -P ${CMAKE_CURRENT_LIST_DIR}/run.cmake)
set_tests_properties(consumer PROPERTIES TIMEOUT 3600)
