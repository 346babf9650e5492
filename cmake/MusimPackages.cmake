# Debian packages by CPack, as `scripts/package` makes them: musim, libmusim-dev and musim-doc, one per component of MusimInstall.cmake.
set(MUSIM_MAINTAINER "The musim developers <musim@packages.invalid>" CACHE STRING "Who answers for Debian packages made here")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME musim)
set(CPACK_PACKAGE_VENDOR "The musim developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own, the first line of its description
set(CPACK_PACKAGE_CONTACT "${MUSIM_MAINTAINER}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL program development documentation)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/packages/finish.cmake)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME musim)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libjs-three")      # the blocks in 3D on pages of `musim report`
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "musim-doc, ffmpeg")  # films of `musim field`
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "similitude and LS-DEM simulation of dry-stacked blocks
For people who shake structures of dry-stacked blocks: towers for gravity
energy storage, multi-drum columns, dry masonry. musim rescales an earthquake
record by a similitude law, simulates the structure at prototype and model
scale (level-set discrete elements in frictional contact), and says whether
the runs agree in dimensionless form, until when, and how much a real model
is distorted.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libmusim-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(musim_needs "libboost-dev (>= 1.74)" "libeigen3-dev (>= 3.4)" libfmt-dev nlohmann-json3-dev libhdf5-dev zlib1g-dev)
if(MUSIM_MINISEED)
  list(APPEND musim_needs libmseed-dev libpugixml-dev)
endif()
if(MUSIM_ZIP)
  list(APPEND musim_needs libzip-dev)
endif()
if(MUSIM_CLP)
  list(APPEND musim_needs coinor-libclp-dev)
endif()
if(TARGET PkgConfig::RSVG)
  list(APPEND musim_needs "librsvg2-dev (>= 2.52)" pkgconf)
endif()
list(JOIN musim_needs ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS musim-doc)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "C++ libraries of musim (similitude, ground motions, LS-DEM)
Static libraries, headers and the CMake package of musim: units and laws of
similitude, ground-motion records, and the simulation of dry-stacked blocks
by level-set discrete elements. Programs write find_package(musim).")

set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_NAME musim-doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)
set(CPACK_COMPONENT_DOCUMENTATION_DESCRIPTION "manuals of musim (similitude and LS-DEM of dry-stacked blocks)
How to scale a test, process a record, check a shake table, run and compare
structures of dry-stacked blocks with musim; its mathematics, and what its
results were checked against.")

include(CPack)
