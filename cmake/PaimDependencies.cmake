# What Paim links, all from the distribution's packages (the list is in ./packages).

# The runtime: Zstandard and meshoptimizer, and headers of the others.
find_package(Eigen3 3.3 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
list(APPEND CMAKE_MODULE_PATH ${PROJECT_SOURCE_DIR}/cmake)
find_path(XXHASH_INCLUDE_DIR NAMES xxhash.h REQUIRED)
find_package(zstd REQUIRED)
find_package(meshoptimizer REQUIRED)
if(PAIM_RUNTIME_ONLY)
    return()
endif()

# The tools, the player and the tests.
find_package(TBB REQUIRED)
find_package(PkgConfig REQUIRED)
find_package(CLI11 REQUIRED)
find_path(STB_INCLUDE_DIR NAMES stb_image.h PATH_SUFFIXES stb REQUIRED)

# OpenEXR 3 brings a CMake package; OpenEXR 2 (Ubuntu 22.04) is found through pkg-config. Consumers of
# the installed library find the same one, so the target is named here and linked by that name.
find_package(OpenEXR 3 CONFIG QUIET)
if(OpenEXR_FOUND)
    set(PAIM_OPENEXR_VERSION 3)
    set(PAIM_OPENEXR_TARGET OpenEXR::OpenEXR)
else()
    pkg_check_modules(OPENEXR2 REQUIRED IMPORTED_TARGET OpenEXR)
    set(PAIM_OPENEXR_VERSION 2)
    set(PAIM_OPENEXR_TARGET PkgConfig::OPENEXR2)
endif()

# Embree 4 where the system has it, else Embree 3; paim/trace/embree.h tells them apart.
find_package(embree 4 QUIET)
if(embree_FOUND)
    set(PAIM_EMBREE_VERSION 4)
else()
    find_package(embree 3 REQUIRED)
    set(PAIM_EMBREE_VERSION 3)
endif()
