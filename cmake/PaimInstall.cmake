# Installs the library in two components: `runtime` to play .paim files, `tools` to bake and encode as well.
# Tools install themselves.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/paim)

# The runtime: exactly these headers are its interface.
set(runtime_headers
    base/check.h
    base/error.h
    base/export.h
    base/message.h
    base/parallel_hook.h
    base/vector.h
    codec/asset.h
    codec/decode_limits.h
    codec/low_rank.h
    codec/playback.h
    codec/stored_values.h
    codec/transfer_model.h
    format/paim/paim_read.h
    light/light.h
    mesh/root_motion.h
    mesh/texture.h
    mesh/topology.h
    paim.h
    sh/index.h
    transfer/layout.h)
install(TARGETS paim_runtime EXPORT paim-runtime-targets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT runtime)
install(EXPORT paim-runtime-targets NAMESPACE paim:: DESTINATION ${package_dir} COMPONENT runtime)
foreach(header IN LISTS runtime_headers)
    get_filename_component(directory ${header} DIRECTORY)
    install(FILES ${PROJECT_SOURCE_DIR}/paim/${header}
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/paim/${directory} COMPONENT runtime)
endforeach()

# Interfaces may change with every 0.x; the version file allows the same 0.x only.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/paim-config-version.cmake
    COMPATIBILITY SameMinorVersion)
configure_package_config_file(cmake/paim-config.cmake.in ${PROJECT_BINARY_DIR}/paim-config.cmake
    INSTALL_DESTINATION ${package_dir}
    NO_SET_AND_CHECK_MACRO)
install(FILES
    ${PROJECT_BINARY_DIR}/paim-config.cmake
    ${PROJECT_BINARY_DIR}/paim-config-version.cmake
    ${PROJECT_SOURCE_DIR}/cmake/Findzstd.cmake
    DESTINATION ${package_dir} COMPONENT runtime)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)

# The tools' libraries with all headers.
if(PAIM_BUILD_TOOLS)
    install(TARGETS paim_tools paim_trace paim_material paim_bake paim_encode paim_all_tools
        EXPORT paim-tools-targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT tools)
    install(EXPORT paim-tools-targets NAMESPACE paim:: DESTINATION ${package_dir} COMPONENT tools)
    foreach(room base codec format image light mesh metrics sh shade trace transfer)
        install(DIRECTORY ${PROJECT_SOURCE_DIR}/paim/${room}
            DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/paim COMPONENT tools
            FILES_MATCHING PATTERN "*.h")
    endforeach()
    foreach(room bake encode material scene)
        install(DIRECTORY ${PROJECT_SOURCE_DIR}/compressor/${room}
            DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/compressor COMPONENT tools
            FILES_MATCHING PATTERN "*.h")
    endforeach()
endif()
