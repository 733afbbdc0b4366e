// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/cli/compare_arguments.hpp"

#include <CLI/CLI.hpp>

#include "tools/scenario/range_text.hpp"
#include "tools/scenario/schema_kinds.hpp"

namespace scarp {
namespace {

class ArgumentAdder {
 public:
  /// @param path of the table in the scenario
  ArgumentAdder(CLI::App& verb, std::string prefix, std::string path)
      : verb_(verb), prefix_(std::move(prefix)), path_(std::move(path)), group_("Keys of [" + path_ + "]") {}

  template <class T>
  void operator()(std::string_view key, T& member, const Spec& spec) const {
    if constexpr (is_optional<T>) {
      if constexpr (Described<typename T::value_type>)
        static_assert(!Described<typename T::value_type>, "optional tables have no options");
      else
        add<typename T::value_type>(key, spec, [&member](typename T::value_type value) { member = std::move(value); });
    } else if constexpr (Described<T>) {
      const std::string name(key), path = path_ + "." + name;
      // Keys of these say what they are of only together with the table's name.
      const bool named = name == "tolerance" || name == "alignment" || name.starts_with("scanner_");
      member.describe(ArgumentAdder(verb_, named ? name + "-" : "", path));
    } else {
      add<T>(key, spec, [&member](T value) { member = std::move(value); });
    }
  }

 private:
  std::string option_name(std::string_view key) const {
    std::string name = "--" + prefix_ + std::string(key);
    std::replace(name.begin(), name.end(), '_', '-');
    return name;
  }

  static std::string text_of(const Spec& spec) {
    const std::string range = range_text(spec, spec.unit);
    if (!range.empty()) return std::string(spec.text) + " (" + range + ")";
    return std::string(spec.text) + (spec.unit.empty() ? "" : " (" + std::string(spec.unit) + ")");
  }

  static void require_range(const std::string& name, double value, const Spec& spec) {
    if (!std::isfinite(value) || !is_within(value, spec))
      throw CLI::ValidationError(name,
                                 CLI::detail::to_string(value) + " is out of range: " + range_text(spec, spec.unit));
  }

  /// Numbers with commas between them, given to `use`.
  template <class Use>
  CLI::Option* numbers(const std::string& name, const Spec& spec, Use use) const {
    const auto checked = [name, spec, use](const std::vector<double>& values) {
      for (double value : values) require_range(name, value, spec);
      use(values);
    };
    return verb_.add_option_function<std::vector<double>>(name, checked, text_of(spec))->delimiter(',');
  }

  template <class T, class Store>
  void add(std::string_view key, const Spec& spec, Store store) const {
    const std::string name = option_name(key);
    if (verb_.get_option_no_throw(name)) return;
    CLI::Option* option = nullptr;
    if constexpr (std::is_same_v<T, bool>) {
      option = verb_.add_flag_function(
          name, [store](std::int64_t count) { store(count > 0); }, text_of(spec));
    } else if constexpr (Enumerated<T>) {
      const auto named = [store](const std::string& text) {
        for (const auto& [known, value] : enum_names<T>::value)
          if (known == text) store(value);
      };
      option = verb_.add_option_function<std::string>(name, named, text_of(spec))
                   ->check(CLI::IsMember(enumerator_names<T>()));
    } else if constexpr (std::is_same_v<T, InputFile>) {
      const auto file = [store](const std::string& path) { store(InputFile{path}); };
      option = verb_.add_option_function<std::string>(name, file, text_of(spec))->check(CLI::ExistingFile);
    } else if constexpr (std::is_same_v<T, std::string>) {
      option = verb_.add_option_function<std::string>(name, store, text_of(spec));
    } else if constexpr (std::is_same_v<T, std::vector<double>>) {
      option = numbers(name, spec, store);
    } else if constexpr (Tuple<T>) {
      constexpr int count = static_cast<int>(std::tuple_size_v<T>);
      option = numbers(name, spec, [store](const std::vector<double>& v) {
                 T tuple;
                 std::copy_n(v.begin(), count, tuple.begin());
                 store(tuple);
               })->expected(count);
    } else if constexpr (std::is_same_v<T, std::vector<Vec2>> || std::is_same_v<T, std::vector<Vec3>>) {
      option = numbers(name, spec, [name, store](const std::vector<double>& v) {
        constexpr std::size_t axes = std::tuple_size_v<typename T::value_type>;
        if (v.size() % axes != 0)
          throw CLI::ValidationError(name, std::to_string(axes) + " numbers for each point, one after the other");
        T points(v.size() / axes);
        for (std::size_t i = 0; i < v.size(); ++i) points[i / axes][i % axes] = v[i];
        store(points);
      });
    } else {
      static_assert(std::is_arithmetic_v<T>, "a kind of key that has no option on the command line");
      const auto checked = [name, spec, store](const T& value) {
        require_range(name, static_cast<double>(value), spec);
        store(value);
      };
      option = verb_.add_option_function<T>(name, checked, text_of(spec));
    }
    option->group(group_);
  }

  CLI::App& verb_;
  std::string prefix_, path_, group_;
};

}  // namespace

void add_compare_arguments(CLI::App& verb, CompareOptions& options) {
  const ArgumentAdder adder(verb, "", "compare");
  options.describe([&](std::string_view key, auto& member, const Spec& spec) {
    if (key != "simulated" && key != "observed") adder(key, member, spec);
  });
}

}  // namespace scarp
