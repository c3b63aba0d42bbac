// Leaks of third-party libraries, for LeakSanitizer (ASAN_OPTIONS=detect_leaks=1). Called by name in builds with
// AddressSanitizer only.

extern "C" const char* __lsan_default_suppressions();  // NOLINT(bugprone-reserved-identifier)

// Coin never frees its types; drivers are unloaded with their leaks, whose frames then have no name.
extern "C" const char* __lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
    return "leak:libCoin.so\n"
           "leak:swrast_dri.so\n"
           "leak:libGLX_mesa.so\n"
           "leak:libEGL_mesa.so\n"
           "leak:libLLVM\n";
}
