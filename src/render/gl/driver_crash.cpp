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

/// Where a call that led nowhere came from; 0 where that is not known.
Address caller_of_nowhere(const ucontext_t& at) {
#if defined(__x86_64__)
    const auto stack = static_cast<Address>(at.uc_mcontext.gregs[REG_RSP]);
    return is_mapped(stack) ? *reinterpret_cast<const Address*>(stack) : 0;
#elif defined(__aarch64__)
    return static_cast<Address>(at.uc_mcontext.regs[30]);
#else
    static_cast<void>(at);
    return 0;
#endif
}

/// A walk from the handler of a signal outwards.
struct Walk {
    const ucontext_t& at;
    enum class Place { handler, between, crash } place = Place::handler;
    Address in_driver = 0;
};

_Unwind_Reason_Code step(_Unwind_Context* frame, void* state) {
    Walk& walk = *static_cast<Walk*>(state);
    Address address = _Unwind_GetIP(frame);
    Owner owner = owner_of(address);
    if (walk.place == Walk::Place::handler) {
        // Between a handler and where the signal came there is a frame of the system.
        if (owner != Owner::program) walk.place = Walk::Place::between;
        return _URC_NO_REASON;
    }
    if (walk.place == Walk::Place::between && owner == Owner::nobody) {
        address = caller_of_nowhere(walk.at);
        owner = owner_of(address);
    }
    walk.place = Walk::Place::crash;
    if (owner == Owner::driver) walk.in_driver = address;
    return owner == Owner::system ? _URC_NO_REASON : _URC_NORMAL_STOP;
}

void note_crash(int signal, siginfo_t* info, void* context) {
    // It may have come while what is needed here was locked.
    ::signal(SIGALRM, SIG_DFL);
    ::alarm(kLongestLook);
    const bool was_sent = info->si_code <= 0 && signal != SIGABRT;
    Walk walk{*static_cast<const ucontext_t*>(context)};
    if (!was_sent) _Unwind_Backtrace(step, &walk);
    if (walk.in_driver != 0 && noted->signal == 0) {
        noted->signal = signal;
        Dl_info library{};
        if (::dladdr(reinterpret_cast<void*>(walk.in_driver), &library) != 0 && library.dli_fname) {
            const char* slash = std::strrchr(library.dli_fname, '/');
            std::strncpy(noted->library.data(), slash ? slash + 1 : library.dli_fname, noted->library.size() - 1);
        }
    }
    // Others that handle crashes (sanitizers) hear of the program's own.
    const std::size_t which =
        static_cast<std::size_t>(std::find(kCrashes.begin(), kCrashes.end(), signal) - kCrashes.begin());
    struct sigaction usual {};
    usual.sa_handler = SIG_DFL;
    ::sigaction(signal, walk.in_driver != 0 ? &usual : &handled_before[which], nullptr);
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
