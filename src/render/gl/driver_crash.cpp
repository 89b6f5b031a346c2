#include <render/gl/driver_crash.h>

#include <dlfcn.h>
#include <link.h>
#include <signal.h>
#include <sys/mman.h>
#include <ucontext.h>
#include <unistd.h>
#include <unwind.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

namespace {

using Address = std::uintptr_t;

constexpr std::array kCrashes{SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT};
constexpr unsigned kLongestLook = 3;  // seconds

enum class Owner { program, system, driver, nobody };

struct Code {
    Address begin, end;
    Owner owner;
};

/// Read by a handler of signals: it stays as it is once there is one.
std::vector<Code> loaded_first;
CrashNote* noted = nullptr;
std::array<struct sigaction, kCrashes.size()> handled_before;

int add_object(dl_phdr_info* object, std::size_t /*size*/, void* first) {
    bool& is_first = *static_cast<bool*>(first);
    for (int i = 0; i < object->dlpi_phnum; ++i) {
        const auto& part = object->dlpi_phdr[i];
        if (part.p_type != PT_LOAD) continue;
        const Address begin = object->dlpi_addr + part.p_vaddr;
        loaded_first.push_back({begin, begin + part.p_memsz, is_first ? Owner::program : Owner::system});
    }
    is_first = false;
    return 0;
}

bool is_mapped(Address address) {
    const auto page = static_cast<Address>(::sysconf(_SC_PAGESIZE));
    return ::msync(reinterpret_cast<void*>(address / page * page), page, MS_ASYNC) == 0 || errno != ENOMEM;
}

Owner owner_of(Address address) {
    for (const Code& code : loaded_first) {
        if (address >= code.begin && address < code.end) return code.owner;
    }
    // What a driver compiles stands in no library.
    return is_mapped(address) ? Owner::driver : Owner::nobody;
}

/// Where a process was.
Address stop_of(const ucontext_t& context) {
#if defined(__x86_64__)
    return static_cast<Address>(context.uc_mcontext.gregs[REG_RIP]);
#elif defined(__aarch64__)
    return static_cast<Address>(context.uc_mcontext.pc);
#else
    static_cast<void>(context);
    return reinterpret_cast<Address>(&note_program);  // unknown: as if it were in some code
#endif
}

/// Who called, if a call is the last thing that it did. No sanitizer knows of a frame that is only begun.
[[gnu::no_sanitize_address]] Address caller_of_stop(const ucontext_t& context) {
#if defined(__x86_64__)
    const auto stack = static_cast<Address>(context.uc_mcontext.gregs[REG_RSP]);
    return is_mapped(stack) ? *reinterpret_cast<const Address*>(stack) : 0;
#elif defined(__aarch64__)
    return static_cast<Address>(context.uc_mcontext.regs[30]);
#else
    static_cast<void>(context);
    return 0;
#endif
}

/// A walk from the handler of a signal outwards.
struct Walk {
    bool is_in_handler = true;
    Address in_driver = 0;
};

_Unwind_Reason_Code step(_Unwind_Context* frame, void* state) {
    Walk& walk = *static_cast<Walk*>(state);
    const Address address = _Unwind_GetIP(frame);
    const Owner owner = owner_of(address);
    if (walk.is_in_handler) {
        // Its caller is the system's, and then comes where the signal did.
        walk.is_in_handler = owner == Owner::program;
        return _URC_NO_REASON;
    }
    if (owner == Owner::driver) walk.in_driver = address;
    return owner == Owner::system ? _URC_NO_REASON : _URC_NORMAL_STOP;
}

/// An address in the driver, if it is the driver that crashed; else 0.
Address driver_at(const ucontext_t& context) {
    // A call that led nowhere cannot be walked from.
    if (owner_of(stop_of(context)) == Owner::nobody) {
        const Address caller = caller_of_stop(context);
        return owner_of(caller) == Owner::driver ? caller : 0;
    }
    Walk walk;
    _Unwind_Backtrace(step, &walk);
    return walk.in_driver;
}

void note_crash(int signal, siginfo_t* info, void* context) {
    // It may have come while what is needed here was locked.
    ::signal(SIGALRM, SIG_DFL);
    ::alarm(kLongestLook);
    const bool was_sent = info->si_code <= 0 && signal != SIGABRT;
    const Address driver = was_sent ? 0 : driver_at(*static_cast<const ucontext_t*>(context));
    if (driver != 0 && noted->signal == 0) {
        noted->signal = signal;
        Dl_info library{};
        if (::dladdr(reinterpret_cast<void*>(driver), &library) != 0 && library.dli_fname) {
            const char* slash = std::strrchr(library.dli_fname, '/');
            std::strncpy(noted->library.data(), slash ? slash + 1 : library.dli_fname, noted->library.size() - 1);
        }
    }
    // Others that handle crashes (sanitizers) hear of the program's own.
    const std::size_t which =
        static_cast<std::size_t>(std::find(kCrashes.begin(), kCrashes.end(), signal) - kCrashes.begin());
    struct sigaction usual {};
    usual.sa_handler = SIG_DFL;
    ::sigaction(signal, driver != 0 ? &usual : &handled_before[which], nullptr);
    ::alarm(0);
    // A fault comes again by itself, with its place.
    if (info->si_code <= 0) ::raise(signal);
}

}  // namespace

void note_program() {
    loaded_first.clear();
    bool first = true;
    ::dl_iterate_phdr(add_object, &first);
}

void note_crashes(CrashNote& note) {
    noted = &note;
    struct sigaction action {};
    action.sa_sigaction = note_crash;
    action.sa_flags = SA_SIGINFO;
    for (std::size_t i = 0; i < kCrashes.size(); ++i) ::sigaction(kCrashes[i], &action, &handled_before[i]);
}

std::string described(const CrashNote& note) {
    const std::string_view library = note.library.data();
    return std::string("crashed (") + ::strsignal(note.signal) +
           (library.empty() ? "" : " in " + std::string(library)) + ")";
}

}  // namespace mobbscope
