// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/scenario/formula.hpp"

#include <muParser.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string_view>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

/// One formula and the variables it is bound to.
class Formula {
 public:
  explicit Formula(const std::string& text) {
    parser_.DefineVar("X", &values_[0]);
    parser_.DefineVar("Y", &values_[1]);
    parser_.DefineVar("Z", &values_[2]);
    parser_.DefineVar("t", &values_[3]);
    parser_.DefineConst("pi", std::numbers::pi);
    // muParser would let a formula assign to its variables.
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text[i] == '=' && (i == 0 || std::string_view("=!<>").find(text[i - 1]) == std::string_view::npos) &&
          (i + 1 == text.size() || text[i + 1] != '='))
        throw mu::ParserError("\"=\" is no operator; to compare there is \"==\"", static_cast<int>(i), text);
    parser_.SetExpr(text);
    if (parser_.Eval(); parser_.GetNumResults() != 1)
      throw mu::ParserError("one formula, not a list of them", static_cast<int>(text.find(',')), text);
  }
  Formula(const Formula&) = delete;
  Formula& operator=(const Formula&) = delete;

  double operator()(const Vec3& X, double t) {
    values_ = {X[0], X[1], X[2], t};
    return parser_.Eval();
  }
  std::string text() const { return parser_.GetExpr(); }

 private:
  mu::Parser parser_;
  std::array<double, 4> values_{0, 0, 0, 0};
};

std::string sentence(const mu::ParserError& mistake) { return mistake.GetMsg(); }

}  // namespace

std::string mistake_in_formula(const std::string& formula) {
  try {
    const Formula compiled(formula);
    return {};
  } catch (const mu::ParserError& mistake) {
    return sentence(mistake);
  }
}

Field compile_field(const std::string& what, const std::vector<std::string>& formulas, const Vec3& origin) {
  auto compiled = std::make_shared<std::vector<std::unique_ptr<Formula>>>();
  for (const std::string& formula : formulas) {
    if (const std::string mistake = mistake_in_formula(formula); !mistake.empty())
      throw Error("scenario", what + " is no formula: " + mistake, formula, "a formula of X, Y, Z and t");
    compiled->push_back(std::make_unique<Formula>(formula));
  }
  return [compiled, what, origin](const Vec3& X, double t) {
    Vec3 value{0, 0, 0};
    for (std::size_t a = 0; a < compiled->size(); ++a) {
      value[a] = (*(*compiled)[a])(X + origin, t);
      if (!std::isfinite(value[a]))
        throw Error("solve",
                    what + " has no finite value at (" + shortest(X[0] + origin[0]) + ", " +
                        shortest(X[1] + origin[1]) + ", " + shortest(X[2] + origin[2]) + "), t = " + shortest(t) + " s",
                    (*compiled)[a]->text(), "a finite number");
    }
    return value;
  };
}

}  // namespace scarp
