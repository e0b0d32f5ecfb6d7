// The HDF5 library loses some of its own memory when it meets a damaged file; the leak checker of the debug build is
// told to look past it.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5\n"; }
