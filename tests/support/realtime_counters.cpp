// SPDX-License-Identifier: MIT
#include "tests/support/realtime_counters.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <semaphore.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstddef>
#include <cstdio>

namespace {

// Constant-initialised, so that no allocation is needed to reach them; malloc itself looks here.
thread_local bool counting = false;
thread_local burin::test::RealtimeCounts counts;

template <typename Function>
Function next(const char* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

void count(std::uint64_t& counter) {
    if (counting) ++counter;
}

}  // namespace

namespace burin::test {

RealtimeScope::RealtimeScope() noexcept {
    ::counts = {};
    counting = true;
}
RealtimeScope::~RealtimeScope() { counting = false; }
RealtimeCounts RealtimeScope::counts() const noexcept { return ::counts; }

}  // namespace burin::test

extern "C" {

// glibc's own names for what is replaced here; dlsym would have to allocate.
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);

void* malloc(std::size_t size) {
    count(counts.allocations);
    return __libc_malloc(size);
}
void* calloc(std::size_t n, std::size_t size) {
    count(counts.allocations);
    return __libc_calloc(n, size);
}
void* realloc(void* p, std::size_t size) {
    count(counts.allocations);
    return __libc_realloc(p, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
    count(counts.allocations);
    return __libc_memalign(alignment, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
    count(counts.allocations);
    return __libc_memalign(alignment, size);
}
int posix_memalign(void** p, std::size_t alignment, std::size_t size) {
    count(counts.allocations);
    *p = __libc_memalign(alignment, size);
    return *p != nullptr ? 0 : ENOMEM;
}
void free(void* p) {
    count(counts.frees);
    __libc_free(p);
}

int pthread_mutex_lock(pthread_mutex_t* mutex) {
    static const auto real = next<int (*)(pthread_mutex_t*)>("pthread_mutex_lock");
    count(counts.locks);
    return real(mutex);
}
int pthread_rwlock_rdlock(pthread_rwlock_t* lock) {
    static const auto real = next<int (*)(pthread_rwlock_t*)>("pthread_rwlock_rdlock");
    count(counts.locks);
    return real(lock);
}
int pthread_rwlock_wrlock(pthread_rwlock_t* lock) {
    static const auto real = next<int (*)(pthread_rwlock_t*)>("pthread_rwlock_wrlock");
    count(counts.locks);
    return real(lock);
}
int pthread_cond_wait(pthread_cond_t* condition, pthread_mutex_t* mutex) {
    static const auto real = next<int (*)(pthread_cond_t*, pthread_mutex_t*)>("pthread_cond_wait");
    count(counts.locks);
    return real(condition, mutex);
}
int sem_wait(sem_t* semaphore) {
    static const auto real = next<int (*)(sem_t*)>("sem_wait");
    count(counts.locks);
    return real(semaphore);
}

[[noreturn]] void __cxa_throw(void* object, void* type, void (*destroy)(void*)) {
    static const auto real = next<void (*)(void*, void*, void (*)(void*))>("__cxa_throw");
    count(counts.throws);
    real(object, type, destroy);
    __builtin_unreachable();
}

FILE* fopen(const char* path, const char* mode) {
    static const auto real = next<FILE* (*)(const char*, const char*)>("fopen");
    count(counts.files);
    return real(path, mode);
}
int open(const char* path, int flags, ...) {
    static const auto real = next<int (*)(const char*, int, ...)>("open");
    count(counts.files);
    std::va_list rest;
    va_start(rest, flags);
    const mode_t mode = (flags & (O_CREAT | __O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : mode_t{0};
    va_end(rest);
    return real(path, flags, mode);
}
ssize_t read(int file, void* to, std::size_t size) {
    static const auto real = next<ssize_t (*)(int, void*, std::size_t)>("read");
    count(counts.files);
    return real(file, to, size);
}
ssize_t write(int file, const void* from, std::size_t size) {
    static const auto real = next<ssize_t (*)(int, const void*, std::size_t)>("write");
    count(counts.files);
    return real(file, from, size);
}

}  // extern "C"
