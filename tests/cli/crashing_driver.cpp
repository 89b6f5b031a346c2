// Stands for libOSMesa.so.8 and libEGL.so.1: a driver that MOBBSCOPE_TEST_DRIVER says the fault of.
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace {

/// The first process begins again with the real driver; the others have none. `taken`: the file that the first makes.
void draw_in_one_process(const std::string& taken) {
    if (::open(taken.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0600) < 0) return;
    ::unsetenv("LD_LIBRARY_PATH");
    std::ifstream file("/proc/self/cmdline");
    std::vector<std::string> arguments;
    for (std::string argument; std::getline(file, argument, '\0');) arguments.push_back(argument);
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    ::execv("/proc/self/exe", pointers.data());
}

void* fail() {
    const char* fault = std::getenv("MOBBSCOPE_TEST_DRIVER");
    const std::string_view what = fault ? fault : "";
    if (what == "nowhere") {
        void (*volatile nowhere)() = reinterpret_cast<void (*)()>(64);
        nowhere();
    }
    if (const std::string_view one = "in one process "; what.starts_with(one)) {
        draw_in_one_process(std::string(what.substr(one.size())));
        return nullptr;
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
