// Text made safe for LaTeX.
#include <fmt/format.h>

#include <array>
#include <cstdint>

#include "reports/replace_characters.h"
#include "reports/text.h"

namespace sluice {

namespace {

constexpr std::array<Replacement, 86> latex_characters = {{{"\\", "\\textbackslash{}"},
                                                           {"{", "\\{"},
                                                           {"}", "\\}"},
                                                           {"$", "\\$"},
                                                           {"&", "\\&"},
                                                           {"#", "\\#"},
                                                           {"%", "\\%"},
                                                           {"_", "\\_"},
                                                           {"~", "\\textasciitilde{}"},
                                                           {"^", "\\textasciicircum{}"},
                                                           {"<", "$<$"},
                                                           {">", "$>$"},
                                                           {"\n", " "},
                                                           {"|", "$|$"},
                                                           {"−", "$-$"},
                                                           {"–", "--"},
                                                           {"—", "---"},
                                                           {"×", "$\\times$"},
                                                           {"·", "$\\cdot$"},
                                                           {"±", "$\\pm$"},
                                                           {"≤", "$\\le$"},
                                                           {"≥", "$\\ge$"},
                                                           {"≈", "$\\approx$"},
                                                           {"→", "$\\to$"},
                                                           {"α", "$\\alpha$"},
                                                           {"γ", "$\\gamma$"},
                                                           {"δ", "$\\delta$"},
                                                           {"Δ", "$\\Delta$"},
                                                           {"ν", "$\\nu$"},
                                                           {"ρ", "$\\rho$"},
                                                           {"µ", "$\\mu$"},
                                                           {"°", "$^\\circ$"},
                                                           {"⁻", "$^{-}$"},
                                                           {"⁰", "$^{0}$"},
                                                           {"¹", "$^{1}$"},
                                                           {"²", "$^{2}$"},
                                                           {"³", "$^{3}$"},
                                                           {"⁴", "$^{4}$"},
                                                           {"⁵", "$^{5}$"},
                                                           {"⁶", "$^{6}$"},
                                                           {"⁷", "$^{7}$"},
                                                           {"⁸", "$^{8}$"},
                                                           {"⁹", "$^{9}$"},
                                                           {"₀", "$_{0}$"},
                                                           {"₁", "$_{1}$"},
                                                           {"₂", "$_{2}$"},
                                                           {"₃", "$_{3}$"},
                                                           {"\u202f", "\\,"},
                                                           {"\u00a0", "~"},
                                                           {"…", "\\ldots{}"},
                                                           {"“", "``"},
                                                           {"”", "''"},
                                                           {"‘", "`"},
                                                           {"’", "'"},
                                                           {"σ", "$\\sigma$"},
                                                           {"π", "$\\pi$"},
                                                           {"τ", "$\\tau$"},
                                                           {"∞", "$\\infty$"},
                                                           {"\"", "''"},
                                                           {"β", "$\\beta$"},
                                                           {"ε", "$\\varepsilon$"},
                                                           {"ζ", "$\\zeta$"},
                                                           {"η", "$\\eta$"},
                                                           {"θ", "$\\theta$"},
                                                           {"ι", "$\\iota$"},
                                                           {"κ", "$\\kappa$"},
                                                           {"λ", "$\\lambda$"},
                                                           {"μ", "$\\mu$"},
                                                           {"ξ", "$\\xi$"},
                                                           {"φ", "$\\varphi$"},
                                                           {"χ", "$\\chi$"},
                                                           {"ψ", "$\\psi$"},
                                                           {"ω", "$\\omega$"},
                                                           {"Γ", "$\\Gamma$"},
                                                           {"Θ", "$\\Theta$"},
                                                           {"Λ", "$\\Lambda$"},
                                                           {"Ξ", "$\\Xi$"},
                                                           {"Π", "$\\Pi$"},
                                                           {"Σ", "$\\Sigma$"},
                                                           {"Φ", "$\\Phi$"},
                                                           {"Ψ", "$\\Psi$"},
                                                           {"Ω", "$\\Omega$"},
                                                           {"√", "$\\surd$"},
                                                           {"∂", "$\\partial$"},
                                                           {"∑", "$\\sum$"},
                                                           {"ο", "o"}}};

/// Code point of a well-formed UTF-8 character.
std::uint32_t code_point(std::string_view character) {
  const auto byte = [&](std::size_t k) { return static_cast<std::uint32_t>(static_cast<unsigned char>(character[k])); };
  std::uint32_t value = character.size() == 1 ? byte(0) : byte(0) & (0x7FU >> character.size());
  for (std::size_t k = 1; k < character.size(); ++k) value = value << 6U | (byte(k) & 0x3FU);
  return value;
}

/// Accented letters of western Europe are set as they are. What lies beyond them stops LaTeX, unless packages are
/// loaded that a table taken into another document cannot load: it is called by its number.
std::string known_to_latex(std::string_view text) {
  constexpr std::uint32_t first_accented = 0xC0;
  constexpr std::uint32_t last_accented = 0xFF;
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view c = character(text, i);
    const std::uint32_t code = code_point(c);
    const bool is_known = code < 0x80 || (code >= first_accented && code <= last_accented);
    out += is_known ? std::string(c) : fmt::format("[U+{:04X}]", code);
    i += c.size();
  }
  return out;
}

}  // namespace

std::string escape_latex(std::string_view text) {
  return known_to_latex(replace_characters(text, latex_characters));
}

}  // namespace sluice
