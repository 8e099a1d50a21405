#pragma once
/// Storage for tables of many megabytes of which a step reads a little here and there: on the processor's large pages
/// where the system has some. On small ones such looks miss the TLB.
#include <sys/mman.h>

#include <cstddef>
#include <limits>
#include <new>

namespace ostium::core {

/// An allocator. What is less than two large pages lies where it would lie anyway. Throws std::bad_alloc.
template <class T>
struct OnHugePages {
  using value_type = T;

  OnHugePages() = default;
  template <class U>
  OnHugePages(const OnHugePages<U>&) {}  // allocators of all types are one

  T* allocate(std::size_t count) {
    if (count > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_array_new_length();
    const std::size_t bytes = count * sizeof(T);
    if (bytes < least_bytes) return static_cast<T*>(::operator new(bytes));
    void* place = ::operator new(bytes, page);
    madvise(place, bytes, MADV_HUGEPAGE);  // a wish: where it is not granted all works the same
    return static_cast<T*>(place);
  }
  void deallocate(T* place, std::size_t count) {
    if (count * sizeof(T) < least_bytes)
      ::operator delete(place);
    else
      ::operator delete(place, page);
  }
  template <class U>
  bool operator==(const OnHugePages<U>&) const {
    return true;
  }

 private:
  static constexpr std::align_val_t page{std::size_t{2} << 20};
  static constexpr std::size_t least_bytes = std::size_t{4} << 20;
};

}  // namespace ostium::core
