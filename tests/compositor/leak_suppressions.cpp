// Leaks of libraries that we load but did not write, for LeakSanitizer (ASAN_OPTIONS=detect_leaks=1). Called only in
// builds with AddressSanitizer, where it is looked up by its name.

extern "C" const char* __lsan_default_suppressions();  // NOLINT(bugprone-reserved-identifier)

// Coin's types live until the process ends; drivers are unloaded with what they hold, then frames have no name.
extern "C" const char* __lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
    return "leak:libCoin.so\n"
           "leak:swrast_dri.so\n"
           "leak:libGLX_mesa.so\n"
           "leak:libEGL_mesa.so\n"
           "leak:libLLVM\n";
}
