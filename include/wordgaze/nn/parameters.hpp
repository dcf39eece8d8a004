#pragma once
#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "wordgaze/core/types.hpp"

/// Parameters as plain values: a struct of matrices lists its fields once, and the optimizer,
/// clipping, checkpoints, initialization, counting and gradient checks walk that list. Gradients
/// and both Adam moments are objects of the same type.
namespace wordgaze::nn {

/// A member of a tree. A field without a name lends its own fields to its owner: their paths do not
/// show it. `group` names a group of parameters to the optimizer, for the whole branch; 0: that of
/// the owner.
template <class Owner, class Member>
struct Field {
  std::string_view name;
  Member Owner::*member;
  int group = 0;
};
template <class O, class M>
Field(const char*, M O::*) -> Field<O, M>;
template <class O, class M>
Field(const char*, M O::*, int) -> Field<O, M>;

template <class T>
concept Leaf = std::derived_from<std::remove_cvref_t<T>, Eigen::MatrixBase<std::remove_cvref_t<T>>>;
template <class T>
concept Tree = requires {
  std::remove_cvref_t<T>::fields();
};

/// Where a leaf lies in its tree; a small stack of names, so that walking allocates nothing.
struct Path {
  std::array<std::string_view, 8> names{};
  std::size_t depth = 0;
  int group = 0;  ///< the one that the nearest field with a group names

  template <class Owner, class Member>
  Path operator/(const Field<Owner, Member>& field) const {
    Path longer = *this;
    if (!field.name.empty()) longer.names.at(longer.depth++) = field.name;
    if (field.group != 0) longer.group = field.group;
    return longer;
  }
  /// "memory.hidden_weight"
  std::string str() const {
    std::string joined;
    for (std::size_t i = 0; i < depth; ++i) {
      if (i > 0) joined += '.';
      joined += names[i];
    }
    return joined;
  }
};

namespace detail {
template <class F, Leaf A, class... B>
void walk(const Path& path, F& f, A& a, B&... b) {
  f(path, a, b...);
}
template <class F, Tree A, class... B>
void walk(const Path& path, F& f, A& a, B&... b) {
  const auto visit = [&](auto field) {
    walk(path / field, f, a.*(field.member), b.*(field.member)...);
  };
  std::apply([&](auto... field) { (visit(field), ...); }, std::remove_cvref_t<A>::fields());
}
}  // namespace detail

/// Calls f(path, leaf of a, leaf of b...) for each leaf of structurally equal trees, in field
/// order.
template <class F, Tree A, class... B>
requires(std::same_as<std::remove_cvref_t<A>, std::remove_cvref_t<B>>&&...) void for_each_parameter(
    F&& f, A& a, B&... b) {
  detail::walk(Path{}, f, a, b...);
}

template <Tree P>
void set_zero(P& p) {
  for_each_parameter([](const Path&, auto& leaf) { leaf.setZero(); }, p);
}

template <Tree P>
P zeros_like(const P& p) {
  P zero = p;
  set_zero(zero);
  return zero;
}

template <Tree P>
Index count(const P& p) {
  Index total = 0;
  for_each_parameter([&](const Path&, const auto& leaf) { total += leaf.size(); }, p);
  return total;
}

/// One of some equal parts of every leaf, so that workers can share what is done element by
/// element.
struct Part {
  Index number = 0, of = 1;

  /// This part of a leaf, as a column.
  template <Leaf M>
  auto operator()(M& leaf) const {
    using Column = Vector<typename M::Scalar>;
    using View = std::conditional_t<std::is_const_v<M>, const Column, Column>;
    const Index from = leaf.size() * number / of, to = leaf.size() * (number + 1) / of;
    return Eigen::Map<View>(leaf.data() + from, to - from);  // vectorizes, as reshaped() does not
  }
};

/// Sum of squares over all leaves: of short runs in the leaf's own precision, of those in double.
template <Tree P>
double squared_norm(const P& p, Part part = {}) {
  double total = 0;
  for_each_parameter(
      [&](const Path&, const auto& leaf) {
        constexpr Index kRun = 1024;
        const auto column = part(leaf);
        for (Index i = 0; i < column.size(); i += kRun) {
          total += column.segment(i, std::min(kRun, column.size() - i)).squaredNorm();
        }
      },
      p);
  return total;
}

/// a += b, leaf by leaf. A leaf that b leaves empty adds nothing.
template <Tree P>
void add(P& a, const P& b, Part part = {}) {
  for_each_parameter(
      [&](const Path&, auto& x, const auto& y) {
        if (y.size() > 0) part(x) += part(y);
      },
      a, b);
}

}  // namespace wordgaze::nn
