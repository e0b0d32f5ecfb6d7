# Everything comes from Debian 12 packages; the launcher `comma` installs them.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(Threads REQUIRED)

find_path(MED_INCLUDE_DIR med.h REQUIRED)
# The shared MED library of Debian hangs on the HDF5 built with Open MPI, which costs every start of the program the loading
# of MPI. The archive leaves its one parallel function out of the link and works with the serial HDF5 of the same version.
find_library(MED_LIBRARY NAMES libmedC.a REQUIRED)
# HDF5 as an archive too: the shared one brings libraries for remote files (curl, OpenSSL, Kerberos) that take another 5 ms of
# every start.
find_path(HDF5_INCLUDE_DIR hdf5.h PATH_SUFFIXES hdf5/serial REQUIRED)
find_library(HDF5_LIBRARY NAMES libhdf5.a PATH_SUFFIXES hdf5/serial REQUIRED)
find_library(Z_LIBRARY z REQUIRED)
find_library(SZ_LIBRARY sz REQUIRED)
add_library(comma_med INTERFACE)
target_include_directories(comma_med SYSTEM INTERFACE ${MED_INCLUDE_DIR} ${HDF5_INCLUDE_DIR})
target_link_libraries(comma_med INTERFACE ${MED_LIBRARY} ${HDF5_LIBRARY} ${SZ_LIBRARY} ${Z_LIBRARY} Threads::Threads ${CMAKE_DL_LIBS})

# MUMPS and CHOLMOD are opened at run time (solver/linear/shared_library.hpp): linked, they and their BLAS would add some
# 5 ms to the start of every run.
find_path(MUMPS_INCLUDE_DIR dmumps_c.h PATH_SUFFIXES mumps_seq REQUIRED)
find_library(MUMPS_LIBRARY dmumps_seq REQUIRED)
add_library(comma_mumps INTERFACE)
target_include_directories(comma_mumps SYSTEM INTERFACE ${MUMPS_INCLUDE_DIR})
target_compile_definitions(comma_mumps INTERFACE COMMA_MUMPS_LIBRARY="${MUMPS_LIBRARY}")

find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
add_library(comma_cholmod INTERFACE)
target_include_directories(comma_cholmod SYSTEM INTERFACE ${CHOLMOD_INCLUDE_DIR})
target_compile_definitions(comma_cholmod INTERFACE COMMA_CHOLMOD_LIBRARY="${CHOLMOD_LIBRARY}")

# Headers alone.
find_path(SPECTRA_INCLUDE_DIR Spectra/GenEigsSolver.h REQUIRED)
add_library(comma_spectra INTERFACE)
target_include_directories(comma_spectra SYSTEM INTERFACE ${SPECTRA_INCLUDE_DIR})

if(COMMA_TESTS)
  find_path(CATCH2_INCLUDE_DIR catch2/catch.hpp REQUIRED)
  add_library(comma_test_main STATIC ${CMAKE_SOURCE_DIR}/cmake/test_main.cpp)
  target_include_directories(comma_test_main SYSTEM PUBLIC ${CATCH2_INCLUDE_DIR})
  target_compile_options(comma_test_main PRIVATE -O0)
endif()
