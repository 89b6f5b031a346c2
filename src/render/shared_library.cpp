#include <render/shared_library.h>

#include <dlfcn.h>

#include <stdexcept>

namespace mobbscope {

SharedLibrary::SharedLibrary(const std::vector<std::string>& names) {
    std::string reasons;
    for (const std::string& name : names) {
        handle_ = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (handle_) {
            name_ = name;
            return;
        }
        reasons += (reasons.empty() ? "" : ", ") + std::string(dlerror());
    }
    throw std::runtime_error(reasons);
}

// Never closed: Mesa's libraries keep threads and exit handlers that outlive their contexts.
SharedLibrary::~SharedLibrary() = default;

void* SharedLibrary::symbol(const char* name) const {
    if (void* address = dlsym(handle_, name)) return address;
    throw std::runtime_error(name_ + " has no function " + name);
}

}  // namespace mobbscope
