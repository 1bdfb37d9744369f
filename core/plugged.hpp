// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/error.hpp"
#include "core/parameters.hpp"

#include <concepts>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>

namespace mapscore {

// A program that is built outside of this repository may add one kind to a choice of algorithms: a
// segmentation (core/segmentation/plugged_segmentation.hpp) or a fusion rule
// (core/fusion/plugged_rule.hpp). It writes the same struct as the kinds that stand here; a
// `Plugged` in the choice's variant holds it behind an interface, and passes its parameters on.

/// What the sources of this program's own kinds are, as a hash; set by mapscore_add_program
/// (cmake/). Part of the keys of the trials that use them.
inline std::string_view plugged_source;

/// Visits parameters whose struct is known at run time only.
class PluggedVisitor {
 public:
  virtual ~PluggedVisitor() = default;
  virtual void operator()(double& number, const Field& field) = 0;
  virtual void operator()(int& number, const Field& field) = 0;
  virtual void operator()(bool& choice, const Field& field) = 0;
  virtual void operator()(Degrees& angle, const Field& field) = 0;
};

/// The kind that a program adds to a choice. `Interface`: an abstract class of what every kind of
/// the choice can do. Where the program adds none, kKind is empty, and the lists of kinds leave it
/// out. Copies are deep.
template <class Interface>
class Plugged {
 public:
  static inline std::string_view kKind, kMeaning;

  /// A kind with the values of its parameters.
  class Box : public Interface {
   public:
    [[nodiscard]] virtual std::unique_ptr<Box> copy() const = 0;
    [[nodiscard]] virtual bool equals(const Box& other) const = 0;
    /// `draws`: called where a fusion rule lists the parameters of its draws.
    virtual void fields(PluggedVisitor& visit, const std::function<void()>& draws) = 0;
  };

  Plugged() : box_(first_ ? first_->copy() : nullptr) {}
  Plugged(const Plugged& other) : box_(other.box_ ? other.box_->copy() : nullptr) {}
  Plugged(Plugged&&) noexcept = default;
  Plugged& operator=(Plugged other) noexcept {
    box_ = std::move(other.box_);
    return *this;
  }
  ~Plugged() = default;

  /// Adds the kind to the choice; before `main`, by the constructor of a static object.
  static void plug_in(std::string_view kind, std::string_view meaning, std::unique_ptr<Box> first) {
    if (kind.empty() || first_) return void(refused_ = true);
    kKind = kind;
    kMeaning = meaning;
    first_ = std::move(first);
  }

  /// Throws Error where this program adds more than one kind to the choice, one without a name, or
  /// one of which it does not say the sources. `choice`: its name for people.
  static void check(const std::string& choice) {
    if (refused_)
      throw Error(choice +
                  ": this program adds two kinds, or one without a kKind; link one file "
                  "with one kind");
    if (first_ && plugged_source.empty())
      throw Error(choice + " '" + std::string(kKind) +
                  "': the program does not know its source, which decides results; build it by "
                  "mapscore_add_program (docs/extending.md)");
  }

  /// Throws Error where there is no such kind.
  [[nodiscard]] const Interface& operator*() const {
    if (!box_) throw Error("this program adds no kind of its own; name another");
    return *box_;
  }

  static void fields(
      auto& s, auto&& visit, const std::function<void()>& draws = [] {}) {
    constexpr bool is_const = std::is_const_v<std::remove_reference_t<decltype(s)>>;
    Forward<is_const, std::remove_reference_t<decltype(visit)>> forward(visit);
    if (s.box_) s.box_->fields(forward, draws);
  }

  bool operator==(const Plugged& other) const {
    return box_ && other.box_ ? box_->equals(*other.box_) : !box_ && !other.box_;
  }

 private:
  /// Hands each parameter to a visitor that takes any type.
  template <bool is_const, class Visit>
  class Forward : public PluggedVisitor {
   public:
    explicit Forward(Visit& visit) : visit_(visit) {}
    void operator()(double& number, const Field& field) override { hand_on(number, field); }
    void operator()(int& number, const Field& field) override { hand_on(number, field); }
    void operator()(bool& choice, const Field& field) override { hand_on(choice, field); }
    void operator()(Degrees& angle, const Field& field) override { hand_on(angle, field); }

   private:
    template <class T>
    void hand_on(T& member, const Field& field) {
      std::conditional_t<is_const, const T, T>& seen = member;
      visit_(seen, field);
    }
    Visit& visit_;
  };

  static inline std::unique_ptr<const Box> first_;  ///< with its defaults
  static inline bool refused_ = false;

  std::unique_ptr<Box> box_;
};

/// A parameter of a kind that a program adds.
template <class T>
concept PluggedParameter = std::same_as<T, double> || std::same_as<T, int> ||
    std::same_as<T, bool> || std::same_as<T, Degrees>;

/// A Box of the struct `Kind`, but for what its interface asks for.
template <class Interface, class Kind, class Whole>
class PluggedBox : public Plugged<Interface>::Box {
 public:
  using Box = Plugged<Interface>::Box;

  [[nodiscard]] std::unique_ptr<Box> copy() const override {
    return std::make_unique<Whole>(static_cast<const Whole&>(*this));
  }
  [[nodiscard]] bool equals(const Box& other) const override {
    return kind_ == static_cast<const PluggedBox&>(other).kind_;
  }
  void fields(PluggedVisitor& visit, const std::function<void()>& draws) override {
    const auto each = [&visit]<class T>(T& member, const Field& field) {
      static_assert(PluggedParameter<T>,
                    "a parameter of a kind of your own is a double, int, bool or Degrees");
      visit(member, field);
    };
    if constexpr (requires { Kind::fields(kind_, each, draws); })
      Kind::fields(kind_, each, draws);
    else
      Kind::fields(kind_, each);
  }

 protected:
  Kind kind_;
};

}  // namespace mapscore
