// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A number that is shader source: what is computed with it is written down, operation by
/// operation and in the same order, as GLSL and OSL both read it. A formula of the closures that
/// is instantiated for it becomes the text of that very formula.
///
/// Quotients and roots get variables of their own, in a ShaderFunction; all else is written in
/// place.

#pragma once

#include <regain/closures/number.h>

#include <string>
#include <vector>

namespace regain::tools {

/// The body of one function.
class ShaderFunction
{
public:
    /// A new variable for the value of `text`; returns its name.
    std::string variable(const std::string& text);

    /// "float NAME(float ARGUMENT, ...) { ... }" that returns `result`, in lines of at most 96
    /// characters.
    std::string text(const std::string& name, const std::vector<std::string>& arguments,
                     const std::string& result) const;

private:
    std::vector<std::string> _values;
};

class ShaderExpression
{
public:
    /// A literal: the shortest decimal that is this float.
    explicit ShaderExpression(float literal);
    /// An argument of the function, by its name.
    ShaderExpression(ShaderFunction& function, const std::string& name);

    const std::string& text() const { return _text; }

    friend ShaderExpression operator+(const ShaderExpression& a, const ShaderExpression& b);
    friend ShaderExpression operator-(const ShaderExpression& a, const ShaderExpression& b);
    friend ShaderExpression operator*(const ShaderExpression& a, const ShaderExpression& b);
    friend ShaderExpression operator/(const ShaderExpression& a, const ShaderExpression& b);

    /// name(a) or name(a, b); `kept` in a variable.
    static ShaderExpression call(const std::string& name, const ShaderExpression& a,
                                 const ShaderExpression* b, bool kept);

private:
    // How tightly the outermost operation binds.
    enum class Binds { sum, product, whole };

    ShaderExpression(ShaderFunction* function, std::string text, Binds binds);
    static ShaderFunction* function_of(const ShaderExpression& a, const ShaderExpression& b);
    ShaderExpression kept() const;
    // In parentheses unless it binds at least that tightly.
    std::string as(Binds least) const;

    ShaderFunction* _function = nullptr;
    std::string _text;
    Binds _binds = Binds::whole;
};

}  // namespace regain::tools

REGAIN_NAMESPACE_BEGIN

/// What formulas ask for; there are no masks in them.
template <>
struct NumberTraits<tools::ShaderExpression>
{
    using Expression = tools::ShaderExpression;
    using Mask = bool;

    static Expression min(const Expression& a, const Expression& b)
    {
        return Expression::call("min", a, &b, false);
    }
    static Expression max(const Expression& a, const Expression& b)
    {
        return Expression::call("max", a, &b, false);
    }
    static Expression sqrt(const Expression& x)
    {
        return Expression::call("sqrt", x, nullptr, true);
    }
};

REGAIN_NAMESPACE_END
