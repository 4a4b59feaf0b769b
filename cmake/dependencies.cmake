# Every third-party library, its least version and the Debian packages that contain it. packages.txt
# says what each package is for; tools/check_files.py compares the two.

# leafhull_require(NAME VERSION PACKAGES [ARGS...]): find_package(NAME ARGS...) that checks the
# version and says what to install. It hides what the find modules print, such as the warning that
# Debian's Imath lacks its Python library, which leafhull does not use.
macro(leafhull_require name version packages)
  set(CMAKE_MESSAGE_LOG_LEVEL WARNING)
  find_package(${name} QUIET ${ARGN})
  unset(CMAKE_MESSAGE_LOG_LEVEL)
  set(found_version "${${name}_VERSION}")
  if(NOT found_version)
    string(TOUPPER ${name} upper_name)
    set(found_version "${${upper_name}_VERSION}")
  endif()
  if(NOT found_version)
    set(found_version "${${name}_VERSION_STRING}")
  endif()
  if(NOT found_version)
    set(found_version "${${name}_C_VERSION}")
  endif()
  if(NOT ${name}_FOUND)
    message(FATAL_ERROR "leafhull needs ${name} ${version} or newer and found none. "
                        "On Debian: apt-get install ${packages}")
  elseif(found_version VERSION_LESS "${version}")
    message(FATAL_ERROR "leafhull needs ${name} ${version} or newer and found '${found_version}'. "
                        "On Debian: apt-get install ${packages}")
  endif()
  message(STATUS "${name} ${found_version}")
endmacro()

list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})
leafhull_require(OpenCL 1.2 "ocl-icd-opencl-dev opencl-c-headers opencl-clhpp-headers")
leafhull_require(TBB 2021.0 "libtbb-dev" CONFIG)

# Without these two, OpenVDB's module stops with its own message.
leafhull_require(Boost 1.74 "libboost-iostreams-dev" COMPONENTS iostreams)
leafhull_require(ZLIB 1.2 "zlib1g-dev")
find_path(LEAFHULL_OPENVDB_MODULE FindOpenVDB.cmake
  PATHS ${CMAKE_PREFIX_PATH} ${CMAKE_SYSTEM_PREFIX_PATH}
  PATH_SUFFIXES lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB lib/cmake/OpenVDB
  DOC "The folder of FindOpenVDB.cmake")
mark_as_advanced(LEAFHULL_OPENVDB_MODULE)
if(LEAFHULL_OPENVDB_MODULE)
  list(APPEND CMAKE_MODULE_PATH ${LEAFHULL_OPENVDB_MODULE})
endif()
leafhull_require(OpenVDB 10.0 "libopenvdb-dev")

# Checks whether OpenVDB's library contains its mesher; compiling it here would take half a minute.
include(CheckCXXSourceCompiles)
set(CMAKE_REQUIRED_LIBRARIES OpenVDB::openvdb TBB::tbb)
check_cxx_source_compiles("
  #include <openvdb/openvdb.h>
  #include <openvdb/tools/VolumeToMesh.h>
  extern template void openvdb::tools::VolumeToMesh::operator()(const openvdb::FloatGrid&);
  int main() { openvdb::tools::VolumeToMesh(0, 0)(*openvdb::FloatGrid::create()); }
" LEAFHULL_OPENVDB_HAS_MESHER)
unset(CMAKE_REQUIRED_LIBRARIES)

leafhull_require(TinyGLTF 2.7 "libtinygltf-dev" CONFIG)
leafhull_require(tinyobjloader 2.0.0 "libtinyobjloader-dev" CONFIG)
leafhull_require(nlohmann_json 3.11 "nlohmann-json3-dev" CONFIG)
leafhull_require(draco 1.5 "libdraco-dev" CONFIG)
leafhull_require(meshoptimizer 0.18 "libmeshoptimizer-dev" CONFIG)
leafhull_require(stb 0 "libstb-dev")
leafhull_require(WebP 2.8 "libwebp-dev")
leafhull_require(Eigen3 3.4 "libeigen3-dev" CONFIG)
leafhull_require(CLI11 2.1 "libcli11-dev" CONFIG)
include(${CMAKE_CURRENT_LIST_DIR}/ufbx.cmake)
if(LEAFHULL_RENDER)
  leafhull_require(embree 3.13 "libembree-dev" 3.13 CONFIG)
  leafhull_require(OpenEXR 3.1 "libopenexr-dev" CONFIG)
  leafhull_require(OpenSans 0 "fonts-open-sans")
endif()
if(LEAFHULL_STUDY)
  leafhull_require(kainjow_mustache 4.1 "libkainjow-mustache-dev")
endif()
if(LEAFHULL_RUNS)
  leafhull_require(OpenSSL 3.0 "libssl-dev" COMPONENTS Crypto)
endif()
if(LEAFHULL_FOREST)
  include(${CMAKE_CURRENT_LIST_DIR}/mpi.cmake)
endif()
if(LEAFHULL_BUILD_BENCH)
  leafhull_require(CGAL 5.5 "libcgal-dev" CONFIG)
endif()

# Debian's libdraco exports another version of tinygltf's symbols, so the linker must meet ours first.
target_link_libraries(TinyGLTF::TinyGLTF INTERFACE draco::draco)
