// Stands for libOSMesa.so.8 and libEGL.so.1: a driver that MOBBSCOPE_TEST_DRIVER says the fault of.
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace {

void* fail() {
    const char* fault = std::getenv("MOBBSCOPE_TEST_DRIVER");
    const std::string_view what = fault ? fault : "";
    if (what == "nowhere") {
        void (*volatile nowhere)() = reinterpret_cast<void (*)()>(64);
        nowhere();
    }
    if (what == "aborts") std::abort();
    if (what == "hangs") {
        for (;;) ::pause();
    }
    volatile char* volatile nothing = reinterpret_cast<volatile char*>(64);
    *nothing = 1;
    return nullptr;
}

}  // namespace

extern "C" {
void* OSMesaCreateContextAttribs(const int*, void*) { return fail(); }
void OSMesaDestroyContext(void*) {}
unsigned char OSMesaMakeCurrent(void*, void*, unsigned, int, int) { return 0; }
void* OSMesaGetProcAddress(const char*) { return nullptr; }
void* eglGetProcAddress(const char*) { return fail(); }
unsigned eglMakeCurrent(void*, void*, void*, void*) { return 0; }
unsigned eglDestroyContext(void*, void*) { return 0; }
}
