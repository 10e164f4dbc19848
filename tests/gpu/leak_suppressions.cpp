// Read by LeakSanitizer, if it is on: the validation layer (1.3.239) leaks a few kB for every misuse that it reports,
// and for a device that lives until the program ends.
extern "C" const char* __lsan_default_suppressions();
const char* __lsan_default_suppressions() { return "leak:libVkLayer_khronos_validation.so\n"; }
