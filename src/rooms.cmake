# Who may use what. CMake builds the rooms of src from this table, tools/check_includes.py holds the
# sources to it, and tools/rooms.py writes the column "knows" of ARCHITECTURE.md from it. All calls have
# the same form because Python reads them too.

# leafhull_library(NAME "ITS NAME" TARGETS what to link; HEADERS the first parts of its headers' paths)
leafhull_library(cgal "CGAL" TARGETS HEADERS CGAL/)
leafhull_library(cli11 "CLI11" TARGETS CLI11::CLI11 HEADERS CLI/)
leafhull_library(draco "draco" TARGETS draco::draco HEADERS draco/)
leafhull_library(eigen "Eigen" TARGETS Eigen3::Eigen HEADERS Eigen/)
leafhull_library(embree "Embree" TARGETS embree HEADERS embree3/)
leafhull_library(gtest "GoogleTest" TARGETS HEADERS gtest/)
leafhull_library(json "nlohmann-json" TARGETS nlohmann_json::nlohmann_json HEADERS nlohmann/)
leafhull_library(meshoptimizer "meshoptimizer" TARGETS meshoptimizer::meshoptimizer HEADERS meshoptimizer.h)
leafhull_library(mpi "MPI (optional)" TARGETS HEADERS mpi.h)
leafhull_library(mustache "mustache" TARGETS kainjow::mustache HEADERS kainjow/)
leafhull_library(opencl "OpenCL" TARGETS OpenCL::OpenCL HEADERS CL/)
leafhull_library(openexr "OpenEXR" TARGETS OpenEXR::OpenEXR HEADERS OpenEXR/)
leafhull_library(openssl "OpenSSL" TARGETS OpenSSL::Crypto HEADERS openssl/)
leafhull_library(openvdb "OpenVDB" TARGETS OpenVDB::openvdb HEADERS openvdb/)
leafhull_library(stb "stb" TARGETS stb::stb HEADERS stb/ stb_)
leafhull_library(tbb "TBB" TARGETS TBB::tbb HEADERS tbb/ oneapi/)
leafhull_library(tinygltf "tinygltf" TARGETS TinyGLTF::TinyGLTF HEADERS tiny_gltf.h)
leafhull_library(tinyobjloader "tinyobjloader" TARGETS tinyobjloader::tinyobjloader HEADERS tiny_obj_loader.h)
leafhull_library(ufbx "ufbx (optional)" TARGETS HEADERS ufbx.h)
leafhull_library(webp "WebP" TARGETS WebP::webp HEADERS webp/)

# leafhull_room(NAME PART; ROOMS that it may include; LIBRARIES that it may use). A part other than CORE
# is left out of the build if LEAFHULL_<PART> is off; RUNS belongs to both STUDY and FOREST. OpenVDB's
# rooms come first, because the loader looks up its 69,000 symbols in the order of the libraries.
leafhull_room(density CORE ROOMS text LIBRARIES openvdb tbb)
leafhull_room(surface CORE ROOMS density text LIBRARIES openvdb tbb)
leafhull_room(input CORE ROOMS colour text
     LIBRARIES tinygltf ufbx tinyobjloader stb webp json draco meshoptimizer tbb)
leafhull_room(colour CORE ROOMS LIBRARIES)
leafhull_room(leaves CORE ROOMS text LIBRARIES eigen tbb)
leafhull_room(foliage CORE ROOMS colour leaves LIBRARIES eigen tbb)
leafhull_room(points CORE ROOMS leaves text LIBRARIES eigen tbb)
leafhull_room(device CORE ROOMS density LIBRARIES opencl)
leafhull_room(output CORE ROOMS colour surface text LIBRARIES tinygltf openvdb json)
leafhull_room(pipeline CORE ROOMS density device points surface text LIBRARIES tbb)
leafhull_room(text CORE ROOMS LIBRARIES)
leafhull_room(options CORE ROOMS density text LIBRARIES)
leafhull_room(process RENDER ROOMS LIBRARIES)
leafhull_room(chart STUDY ROOMS process text LIBRARIES)
leafhull_room(render RENDER ROOMS colour text LIBRARIES embree openexr stb tbb)
leafhull_room(watercolour RENDER ROOMS colour device render text LIBRARIES json)
leafhull_room(picture RENDER
     ROOMS foliage input output pipeline process render surface text watercolour
     LIBRARIES json tbb)
leafhull_room(runs RUNS ROOMS output text LIBRARIES json openssl)
leafhull_room(sweep STUDY ROOMS chart output runs text LIBRARIES)
leafhull_room(study STUDY ROOMS text LIBRARIES)
leafhull_room(page STUDY ROOMS chart output study text LIBRARIES json meshoptimizer mustache)
leafhull_room(scene FOREST ROOMS foliage input text LIBRARIES json stb)
leafhull_room(ranks FOREST ROOMS LIBRARIES mpi)
leafhull_room(tiles FOREST ROOMS density pipeline surface text LIBRARIES tbb)
leafhull_room(forest FOREST ROOMS density output pipeline runs surface text tiles
     LIBRARIES eigen tbb tinygltf)
leafhull_room(cli COMMAND ROOMS text LIBRARIES cli11 json)
leafhull_room(bench BENCH ROOMS density device picture pipeline points surface
     LIBRARIES cgal cli11 gtest json openvdb tbb)
