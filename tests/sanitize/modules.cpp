// Modules stay loaded to the end, so that a leak is reported, or suppressed, by the name of the one that made
// it.
extern "C" int dlclose(void*) noexcept { return 0; }
