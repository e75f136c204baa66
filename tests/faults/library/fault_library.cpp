// A library to be preloaded: it fails one call of one function of the system, and counts the calls.
//
//   TRUNNION_FAULT=write:3      the third call of write fails (counted from main on); 0: none
//                               "stall": write takes no byte and gives no reason
//   TRUNNION_FAULT_COUNT=FILE   at the end the number of calls is written there
#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

struct Plan {
    char function[32] = {};
    long call = 0;
    bool armed = false;
};
Plan plan;
std::atomic<long> calls{0};
using Main = int (*)(int, char**, char**);
Main real_main = nullptr;

/// True for the one call that fails.
bool fails(const char* function) {
    if (!plan.armed || std::strcmp(plan.function, function) != 0) return false;
    return ++calls == plan.call;
}

template <typename Function>
Function real(const char* name) {
    return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

void read_plan() {
    const char* const text = std::getenv("TRUNNION_FAULT");
    const char* const colon = text ? std::strchr(text, ':') : nullptr;
    if (!colon || colon - text >= static_cast<long>(sizeof plan.function)) return;
    std::memcpy(plan.function, text, static_cast<std::size_t>(colon - text));
    plan.call = std::atol(colon + 1);
    plan.armed = true;
}

void write_count() {
    plan.armed = false;
    const char* const path = std::getenv("TRUNNION_FAULT_COUNT");
    std::FILE* const file = path ? std::fopen(path, "w") : nullptr;
    if (!file) return;
    std::fprintf(file, "%ld\n", calls.load());
    std::fclose(file);
}

int watched_main(int argc, char** argv, char** environment) {
    read_plan();
    const int code = real_main(argc, argv, environment);
    write_count();
    return code;
}

}  // namespace

extern "C" {

int __libc_start_main(Main main, int argc, char** argv, void (*init)(), void (*fini)(),
                      void (*rtld_fini)(), void* stack_end) {
    using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
    real_main = main;
    return real<Start>("__libc_start_main")(watched_main, argc, argv, init, fini, rtld_fini,
                                            stack_end);
}

// One wrapper: name, result of a failure, error, result type, parameters, arguments.
#define FAULT(name, failure, error, Result, parameters, arguments)  \
    Result name parameters noexcept(false) {                        \
        static const auto next = real<Result(*) parameters>(#name); \
        if (fails(#name)) {                                         \
            errno = error;                                          \
            return failure;                                         \
        }                                                           \
        return next arguments;                                      \
    }

FAULT(read, -1, EIO, ssize_t, (int file, void* data, size_t size), (file, data, size))
FAULT(pread, -1, EIO, ssize_t, (int file, void* data, size_t size, off_t at),
      (file, data, size, at))
FAULT(pwrite, -1, ENOSPC, ssize_t, (int file, const void* data, size_t size, off_t at),
      (file, data, size, at))
FAULT(fsync, -1, EIO, int, (int file), (file))
FAULT(close, -1, EIO, int, (int file), (file))
FAULT(fchmod, -1, EPERM, int, (int file, mode_t mode), (file, mode))
FAULT(rename, -1, EACCES, int, (const char* from, const char* to), (from, to))
FAULT(linkat, -1, EACCES, int, (int a, const char* from, int b, const char* to, int flags),
      (a, from, b, to, flags))
FAULT(readdir, nullptr, EIO, struct dirent*, (DIR * folder), (folder))
FAULT(mmap, MAP_FAILED, ENOMEM, void*,
      (void* at, size_t size, int protection, int flags, int file, off_t offset),
      (at, size, protection, flags, file, offset))
FAULT(poll, -1, ENOMEM, int, (pollfd * files, nfds_t count, int wait_ms), (files, count, wait_ms))
#undef FAULT

ssize_t write(int file, const void* data, size_t size) {
    using Write = ssize_t (*)(int, const void*, size_t);
    static const auto next = real<Write>("write");
    if (fails("write")) {
        errno = ENOSPC;
        return -1;
    }
    if (fails("stall")) {
        errno = EINTR;  // of an earlier call
        return 0;
    }
    return next(file, data, size);
}

int open(const char* path, int flags, ...) {
    using Open = int (*)(const char*, int, mode_t);
    static const auto next = real<Open>("open");
    std::va_list rest;
    va_start(rest, flags);
    const mode_t mode = va_arg(rest, mode_t);
    va_end(rest);
    // "unnamed": a file system that knows no files without a name.
    if (fails("open") || ((flags & O_TMPFILE) == O_TMPFILE && fails("unnamed"))) {
        errno = (flags & O_TMPFILE) == O_TMPFILE ? EOPNOTSUPP : EACCES;
        return -1;
    }
    return next(path, flags, mode);
}

void* __libc_malloc(size_t size);
void* __libc_realloc(void* old, size_t size);

void* malloc(size_t size) {
    if (fails("malloc")) {
        errno = ENOMEM;
        return nullptr;
    }
    return __libc_malloc(size);
}

void* realloc(void* old, size_t size) {
    if (fails("malloc")) {
        errno = ENOMEM;
        return nullptr;
    }
    return __libc_realloc(old, size);
}

}  // extern "C"
