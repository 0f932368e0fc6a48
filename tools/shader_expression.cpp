// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "shader_expression.h"

#include <fmt/format.h>

#include <utility>

namespace regain::tools {
namespace {

// Broken at spaces, what follows the first line indented by eight.
std::string wrapped(const std::string& line)
{
    constexpr std::size_t width = 96;
    std::string all, rest = line;
    for (std::size_t at; rest.size() > width && (at = rest.rfind(' ', width)) > 8;)
    {
        all += rest.substr(0, at) + "\n";
        rest = "        " + rest.substr(at + 1);
    }
    return all + rest + "\n";
}

}  // namespace

std::string ShaderFunction::variable(const std::string& text)
{
    _values.push_back(text);
    return fmt::format("t{}", _values.size());
}

std::string ShaderFunction::text(const std::string& name, const std::vector<std::string>& arguments,
                                 const std::string& result) const
{
    std::string parameters;
    for (const std::string& argument : arguments)
        parameters += (parameters.empty() ? "float " : ", float ") + argument;
    std::string all = fmt::format("float {}({})\n{{\n", name, parameters);
    for (std::size_t i = 0; i < _values.size(); ++i)
        all += wrapped(fmt::format("    float t{} = {};", i + 1, _values[i]));
    return all + wrapped(fmt::format("    return {};", result)) + "}\n";
}

ShaderExpression::ShaderExpression(float literal) : _text(fmt::format("{}", literal))
{
    // Neither language takes an integer for a float.
    if (_text.find_first_of(".e") == std::string::npos) _text += ".0";
}

ShaderExpression::ShaderExpression(ShaderFunction& function, const std::string& name)
    : ShaderExpression(&function, name, Binds::whole)
{}

ShaderExpression::ShaderExpression(ShaderFunction* function, std::string text, Binds binds)
    : _function(function), _text(std::move(text)), _binds(binds)
{}

ShaderFunction* ShaderExpression::function_of(const ShaderExpression& a, const ShaderExpression& b)
{
    return a._function ? a._function : b._function;
}

ShaderExpression ShaderExpression::kept() const
{
    // A number needs no variable.
    if (!_function) return *this;
    return {_function, _function->variable(_text), Binds::whole};
}

std::string ShaderExpression::as(Binds least) const
{
    return _binds < least ? "(" + _text + ")" : _text;
}

ShaderExpression operator+(const ShaderExpression& a, const ShaderExpression& b)
{
    using Binds = ShaderExpression::Binds;
    // a + -1.0 is read more easily as a - 1.0, which is the same number.
    const bool negative = b._text.front() == '-' && b._binds == Binds::whole;
    return {ShaderExpression::function_of(a, b),
            a._text + (negative ? " - " + b._text.substr(1) : " + " + b.as(Binds::product)),
            Binds::sum};
}
ShaderExpression operator-(const ShaderExpression& a, const ShaderExpression& b)
{
    using Binds = ShaderExpression::Binds;
    return {ShaderExpression::function_of(a, b), a._text + " - " + b.as(Binds::product),
            Binds::sum};
}
ShaderExpression operator*(const ShaderExpression& a, const ShaderExpression& b)
{
    using Binds = ShaderExpression::Binds;
    return {ShaderExpression::function_of(a, b), a.as(Binds::product) + " * " + b.as(Binds::whole),
            Binds::product};
}
ShaderExpression operator/(const ShaderExpression& a, const ShaderExpression& b)
{
    using Binds = ShaderExpression::Binds;
    return ShaderExpression(ShaderExpression::function_of(a, b),
                            a.as(Binds::product) + " / " + b.as(Binds::whole), Binds::product)
        .kept();
}

ShaderExpression ShaderExpression::call(const std::string& name, const ShaderExpression& a,
                                        const ShaderExpression* b, bool kept)
{
    const ShaderExpression result(b ? function_of(a, *b) : a._function,
                                  b ? fmt::format("{}({}, {})", name, a._text, b->_text)
                                    : fmt::format("{}({})", name, a._text),
                                  Binds::whole);
    return kept ? result.kept() : result;
}

}  // namespace regain::tools
