#pragma once
/// Storage for tables of many megabytes that a step reads in scattered places: uses the processor's large pages where
/// available, since such reads would miss the TLB on small pages.
#include <sys/mman.h>

#include <cstddef>
#include <limits>
#include <new>

namespace ostium::core {

/// An allocator. Requests below two large pages are allocated normally. Throws std::bad_alloc.
template <class T>
struct OnHugePages {
  using value_type = T;

  OnHugePages() = default;
  template <class U>
  OnHugePages(const OnHugePages<U>&) {}  // allocators of all types are interchangeable

  T* allocate(std::size_t count) {
    if (count > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_array_new_length();
    const std::size_t bytes = count * sizeof(T);
    if (bytes < least_bytes) return static_cast<T*>(::operator new(bytes));
    void* place = ::operator new(bytes, page);
    madvise(place, bytes, MADV_HUGEPAGE);  // only a hint: without large pages it works the same
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
