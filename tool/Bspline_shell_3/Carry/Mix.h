// Values that are mixed from the values at corners of a model.
#ifndef TOOL_CARRY_MIX_H
#define TOOL_CARRY_MIX_H

#include "../Files/Model.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace Tool {

// corners of a model, and their weights
typedef std::vector<std::pair<std::size_t, double> > Mix;

// Evaluates attributes of points and corners.
class Mixer
{
public:
  explicit Mixer(const Model& model)
  {
    for(const auto& polygon : model.soup.polygons) m_point.insert(m_point.end(), polygon.begin(), polygon.end());
  }

  // Returns the element of a point or corner attribute to which a corner belongs.
  std::size_t element(const Attribute& a, std::size_t corner) const
  {
    return a.element == Element::POINT ? m_point[corner] : corner;
  }

  // Returns the mean of the values, or the value with the largest weight if the attribute has labels.
  std::vector<double> operator()(const Attribute& a, const Mix& mix) const
  {
    const auto largest = [](const Mix& terms) {
      std::size_t i = 0;
      for(std::size_t j = 1; j < terms.size(); ++j)
        if(terms[j].second > terms[i].second) i = j;
      return terms[i].first;
    };
    std::vector<double> value(a.dimension(), 0);
    if(mix.size() == 1 || a.kind == Kind::LABEL) {
      const double* const v = a[element(a, mix.size() == 1 ? mix[0].first : largest(mix))];
      value.assign(v, v + a.dimension());
      return value;
    }
    for(const auto& term : mix)
      for(std::size_t i = 0; i < value.size(); ++i) value[i] += term.second * a[element(a, term.first)][i];
    return value;
  }

private:
  std::vector<std::size_t> m_point; // by corner
};

} // namespace Tool

#endif // TOOL_CARRY_MIX_H
