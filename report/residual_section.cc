// SPDX-License-Identifier: BSD-3-Clause
#include "report/residual_section.h"

#include "report/coordinate_charts.h"
#include "report/distribution_charts.h"
#include "report/leg_charts.h"
#include "report/residual_charts.h"

namespace hexcal {

void AddResidualPictures(const PoseResiduals& residuals, const Scene& scene, HtmlPage* page) {
  page->Figures(ResidualCharts(residuals));
  page->Figures(CoordinateCharts(residuals));
  for (const Chart& chart : SceneCharts(scene)) page->Figure(chart);
  page->Figures(DistributionCharts(residuals));
  const std::vector<Chart> legs = LegCharts(residuals);
  if (legs.empty())
    page->Note("The legs' geometry is not known: there are no pictures in leg space.");
  else
    page->Figures(legs);
}

}  // namespace hexcal
