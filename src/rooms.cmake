# Who may know what. CMake builds the rooms of src from this table, tools/rooms.py holds the sources to
# it and writes the column "knows" of ARCHITECTURE.md. Each call is of one form, as Python reads them too.

# library(NAME "ITS NAME" TARGETS what is linked; HEADERS how the paths of its headers begin)
library(cgal "CGAL" TARGETS HEADERS CGAL/)
library(cli11 "CLI11" TARGETS CLI11::CLI11 HEADERS CLI/)
library(draco "draco" TARGETS draco::draco HEADERS draco/)
library(eigen "Eigen" TARGETS Eigen3::Eigen HEADERS Eigen/)
library(embree "Embree" TARGETS embree HEADERS embree3/)
library(gtest "GoogleTest" TARGETS HEADERS gtest/)
library(json "nlohmann-json" TARGETS nlohmann_json::nlohmann_json HEADERS nlohmann/)
library(meshoptimizer "meshoptimizer" TARGETS meshoptimizer::meshoptimizer HEADERS meshoptimizer.h)
library(mpi "MPI (optional)" TARGETS HEADERS mpi.h)
library(mustache "mustache" TARGETS kainjow::mustache HEADERS kainjow/)
library(opencl "OpenCL" TARGETS OpenCL::OpenCL HEADERS CL/)
library(openexr "OpenEXR" TARGETS OpenEXR::OpenEXR HEADERS OpenEXR/)
library(openssl "OpenSSL" TARGETS OpenSSL::Crypto HEADERS openssl/)
library(openvdb "OpenVDB" TARGETS OpenVDB::openvdb HEADERS openvdb/)
library(stb "stb" TARGETS stb::stb HEADERS stb/ stb_)
library(tbb "TBB" TARGETS TBB::tbb HEADERS tbb/ oneapi/)
library(tinygltf "tinygltf" TARGETS TinyGLTF::TinyGLTF HEADERS tiny_gltf.h)
library(tinyobjloader "tinyobjloader" TARGETS tinyobjloader::tinyobjloader HEADERS tiny_obj_loader.h)
library(ufbx "ufbx (optional)" TARGETS HEADERS ufbx.h)
library(webp "WebP" TARGETS WebP::webp HEADERS webp/)

# room(NAME PART; ROOMS that it may include; LIBRARIES that it alone may know). A part other than CORE is
# left out of the build where LEAFHULL_<PART> is off; RUNS is of both STUDY and FOREST. OpenVDB's rooms come first: the loader looks its
# 69,000 symbols up in the order of the libraries.
room(density CORE ROOMS LIBRARIES openvdb tbb)
room(surface CORE ROOMS density LIBRARIES openvdb tbb)
room(input CORE ROOMS colour text
     LIBRARIES tinygltf ufbx tinyobjloader stb webp json draco meshoptimizer tbb)
room(colour CORE ROOMS LIBRARIES)
room(leaves CORE ROOMS LIBRARIES eigen tbb)
room(foliage CORE ROOMS colour leaves LIBRARIES eigen tbb)
room(points CORE ROOMS leaves LIBRARIES eigen tbb)
room(device CORE ROOMS density LIBRARIES opencl)
room(output CORE ROOMS colour surface text LIBRARIES tinygltf openvdb json)
room(pipeline CORE ROOMS density device points surface LIBRARIES tbb)
room(text CORE ROOMS LIBRARIES)
room(options CORE ROOMS density LIBRARIES)
room(process RENDER ROOMS LIBRARIES)
room(chart STUDY ROOMS process text LIBRARIES)
room(render RENDER ROOMS colour text LIBRARIES embree openexr stb tbb)
room(watercolour RENDER ROOMS colour device render text LIBRARIES json)
room(picture RENDER
     ROOMS foliage input output pipeline process render surface text watercolour
     LIBRARIES json tbb)
room(runs RUNS ROOMS output text LIBRARIES json openssl)
room(sweep STUDY ROOMS chart output runs LIBRARIES)
room(study STUDY ROOMS LIBRARIES)
room(page STUDY ROOMS chart output study text LIBRARIES json meshoptimizer mustache)
room(scene FOREST ROOMS foliage input text LIBRARIES json stb)
room(ranks FOREST ROOMS LIBRARIES mpi)
room(tiles FOREST ROOMS density pipeline surface LIBRARIES tbb)
room(forest FOREST ROOMS density output pipeline runs surface text tiles
     LIBRARIES eigen tbb tinygltf)
room(cli COMMAND ROOMS text LIBRARIES cli11 json)
room(bench BENCH ROOMS density device picture pipeline points surface
     LIBRARIES cgal cli11 gtest json openvdb tbb)
