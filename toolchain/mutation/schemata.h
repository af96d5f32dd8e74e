/// Chooses mutants at run time. Every translation unit of a mutated tree includes this header first (-include).
#pragma once

#include <type_traits>
#include <utility>

namespace mutant {

extern unsigned char chosen[];  ///< of each place the number of the active alternative; 0: none
inline constexpr unsigned char kRecord = 255;

/// Records that the place was reached and returns 0.
unsigned char reached(unsigned place) noexcept;

/// Returns the number of the active alternative of a place; 0: the original code runs.
constexpr unsigned char at(unsigned place) noexcept {
  if (std::is_constant_evaluated()) return 0;
  const unsigned char alternative = chosen[place];
  return __builtin_expect(alternative == kRecord, 0) ? reached(place) : alternative;
}

/// Tells whether T is a block of a matrix, or its transpose, that can be assigned to (Eigen::LvalueBit).
template <class T>
concept Target = requires { requires(T::Flags & 0x20) != 0; } &&
                 (requires(const T& x) { x.startRow(); } || requires(const T& x) { x.nestedExpression().startRow(); });

/// Returns a value that holds no reference to a temporary: an Eigen expression as its matrix, others as a copy. A block
/// of a matrix stays one: it may be the target of an assignment.
template <class T>
constexpr auto value(T&& x) {
  using Plain = std::remove_cvref_t<T>;
  if constexpr (!Target<Plain> && requires { typename Plain::PlainObject; }) {
    return typename Plain::PlainObject(std::forward<T>(x));
  } else {
    return Plain(std::forward<T>(x));
  }
}

/// Returns the result of the last alternative; the caller passes only alternatives that exist.
template <class Result, class Last>
constexpr Result one_of(unsigned, Last&& last) {
  return Result(last());
}
template <class Result, class First, class... Others>
  requires(sizeof...(Others) > 0)
constexpr Result one_of(unsigned number, First&& first, Others&&... others) {
  if (number == 1) return Result(first());
  return one_of<Result>(number - 1, std::forward<Others>(others)...);
}

/// Returns the original's result, or the result of the active alternative converted to its type.
template <class Original, class... Alternatives>
constexpr auto pick(unsigned number, Original&& original, Alternatives&&... alternatives) {
  using Result = decltype(original());
  if (__builtin_expect(number == 0, 1)) return original();
  return one_of<Result>(number, std::forward<Alternatives>(alternatives)...);
}

}  // namespace mutant
