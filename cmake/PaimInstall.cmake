# Installs the library with its headers, package files and licence; tools install themselves.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/paim)

install(TARGETS paim EXPORT paim-targets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(EXPORT paim-targets NAMESPACE paim:: DESTINATION ${package_dir})

# The rooms of paim::paim, without the headers that only their own sources include.
set(public_rooms base codec format image light mesh metrics sh shade transfer)
set(private_headers
    codec/vector_kernels.h
    format/bake/bake_manifest.h
    format/paim/matrix_sections.h
    format/container/mesh_section_writer.h
    format/container/mesh_sections.h
    format/container/metadata.h
    format/paim/paim_metadata.h
    format/paim/paim_packer.h
    format/container/sections.h
    format/pack/index_decoder.h
    format/pack/index_encoder.h
    format/pack/packed_plane.h
    format/pack/plane_decoder.h
    format/pack/plane_encoder.h
    format/pack/plane_packing.h
    format/pack/plane_predictor.h
    format/pack/plane_reconstruct.h
    format/pack/plane_residuals.h
    format/pack/plane_unpacking.h
    format/pack/workspace.h
    format/pack/zstd_decoder.h
    format/pack/zstd_encoder.h
    image/exr_header.h
    sh/recurrence.h)
foreach(header IN LISTS private_headers)
    if(NOT EXISTS ${PROJECT_SOURCE_DIR}/paim/${header})
        message(FATAL_ERROR "paim/${header}: listed as private in PaimInstall.cmake, does not exist")
    endif()
endforeach()
list(TRANSFORM public_rooms PREPEND ${PROJECT_SOURCE_DIR}/paim/)
list(TRANSFORM private_headers REPLACE "(.+)" "PATTERN;\\1;EXCLUDE")
install(DIRECTORY ${public_rooms} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/paim
    FILES_MATCHING PATTERN "*.h" ${private_headers})
install(FILES ${PROJECT_BINARY_DIR}/generated/paim/base/version.h
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/paim/base)

# Interfaces may change with every 0.x; the version file allows the same 0.x only.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/paim-config-version.cmake
    COMPATIBILITY SameMinorVersion)
configure_package_config_file(cmake/paim-config.cmake.in ${PROJECT_BINARY_DIR}/paim-config.cmake
    INSTALL_DESTINATION ${package_dir}
    NO_SET_AND_CHECK_MACRO)
install(FILES
    ${PROJECT_BINARY_DIR}/paim-config.cmake
    ${PROJECT_BINARY_DIR}/paim-config-version.cmake
    ${PROJECT_SOURCE_DIR}/cmake/FindxxHash.cmake
    ${PROJECT_SOURCE_DIR}/cmake/Findzstd.cmake
    DESTINATION ${package_dir})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
