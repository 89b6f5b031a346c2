// Knows nothing of the library: it loads a plug-in and asks that.
#include <dlfcn.h>
#include <cstdio>

int main(int, char** argv) {
    void* const plugin = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
    if (!plugin) {
        std::printf("%s\n", dlerror());
        return 1;
    }
    const auto first_met = reinterpret_cast<int (*)()>(dlsym(plugin, "first_met"));
    if (!first_met) {
        std::printf("%s\n", dlerror());
        return 1;
    }
    std::printf("the first that meets: %d\n", first_met());
}
