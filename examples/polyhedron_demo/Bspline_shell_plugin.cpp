// A plugin of CGAL's Polyhedron demo: builds shells of meshes, edits meshes in them, and maps along their curves.
#include "Progress.h"
#include "carry_properties.h"
#include "places_of.h"

#include "CGAL_double_edit.h"
#include "QMultipleInputDialog.h"
#include "Scene_points_with_normal_item.h"
#include "Scene_surface_mesh_item.h"

#include <CGAL/Bspline_shell_3/Editing/remesh_in_shell.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/Projection/project_points.h>
#include <CGAL/Bspline_shell_3/Surface/extract_shell_surface.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Three/Polyhedron_demo_plugin_helper.h>
#include <CGAL/Three/Scene_group_item.h>
#include <CGAL/Three/Three.h>

#include <QAction>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QMainWindow>
#include <QSpinBox>
#include <QVariant>

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace BS = CGAL::Bspline_shells;
namespace parameters = CGAL::Bspline_shells::parameters;
using CGAL::Three::Scene_item;
using CGAL::Three::Three;
typedef CGAL::Certified_bspline_shell_3 Shell;
typedef Scene_surface_mesh_item Mesh_item;
typedef Scene_points_with_normal_item Points_item;

// A mesh item has its shell as a property, which it shares with the results of its edits.
typedef std::shared_ptr<const Shell> Shell_pointer;
Q_DECLARE_METATYPE(Shell_pointer)

// Stops at a number of facets, or if the user cancels.
class Facets_or_cancel_predicate
{
public:
  Facets_or_cancel_predicate(std::size_t facets, Progress& progress) : m_facets(facets), m_progress(&progress) {}

  template <typename FT, typename Profile>
  bool operator()(const FT& cost, const Profile& profile, std::size_t initial, std::size_t current) const
  {
    return !m_progress->advance(initial - current, initial) || m_facets(cost, profile, initial, current);
  }

private:
  BS::Facet_count_stop_predicate m_facets;
  Progress* m_progress;
};

// The result of a canceled edit is not used.
template <>
struct CGAL::Bspline_shells::Is_repeatable_stop_predicate<Facets_or_cancel_predicate> : std::true_type
{};

class Bspline_shell_plugin : public QObject, public CGAL::Three::Polyhedron_demo_plugin_helper
{
  Q_OBJECT
  Q_INTERFACES(CGAL::Three::Polyhedron_demo_plugin_interface)
  Q_PLUGIN_METADATA(IID "com.geometryfactory.PolyhedronDemo.PluginInterface/1.0")

public:
  void init(QMainWindow* window, CGAL::Three::Scene_interface* scene_interface, Messages_interface*) override;
  QList<QAction*> actions() const override { return m_actions; }
  bool applicable(QAction* action) const override;

public Q_SLOTS:
  // The menu calls these functions after its dialogs, and scripts of the demo call them without. Items are given by
  // their numbers in the list. The functions return the reason of a failure, or an empty text, and write to the
  // demo's console about successes. Times are in seconds, and 0 means no limit.

  // The thickness is a percentage of the longest side of the bounding box.
  QString build_shell(int mesh, double thickness, double time_limit);
  // If `facets` is 0, the result is as coarse as the shell permits.
  QString simplify(int mesh, int facets, double time_limit);
  QString remesh(int mesh, double edge_length, double time_limit);
  // Moves the vertices of a mesh, or points, onto another mesh.
  QString project(int from, int onto);
  QString carry(int from, int to);

private:
  void ask_and_build_shell();
  void ask_and_simplify();
  void ask_and_remesh();
  void ask_and_project();
  void ask_and_carry();
  bool ask_for_direction(const char* title, int& from, int& to);
  void show_failure(const QString& reason);

  template <typename Item>
  Item* item_of(int number) const
  {
    return qobject_cast<Item*>(scene->item(number));
  }
  template <typename Item>
  QList<int> selected() const;
  template <typename Edit>
  QString edit(int number, const char* edited, const Edit& edit);
  template <typename Item>
  QString project(const Item& item, const Mesh_item& target);
  Mesh_item* add_mesh(SMesh mesh, const QString& name, const QColor& color);
  QString add_places(const std::vector<Point_3>& places, const QString& name);

  QList<QAction*> m_actions;
  QAction *m_project = nullptr, *m_carry = nullptr;
};

namespace {

const char* const title = "Cubic B-Spline Shell";
const char* const shell_property = "cubic B-spline shell";

Shell_pointer shell_of(const Scene_item* item)
{
  return item->property(shell_property).value<Shell_pointer>();
}
void set_shell(Scene_item* item, const Shell_pointer& shell)
{
  item->setProperty(shell_property, QVariant::fromValue(shell));
}

double seconds(double time_limit)
{
  return time_limit > 0 ? time_limit : std::numeric_limits<double>::infinity();
}

QString canceled(const QString& name)
{
  Three::information(name + ": canceled, and nothing was changed.");
  return {};
}
QString without_mesh(int number)
{
  return QString("Item %1 is not a surface mesh.").arg(number);
}
QString without_shell(const QString& name)
{
  return name + " has no shell: choose \"Build Shell\" for it first.";
}

// Returns why there is no certified shell, with the first obstacle.
QString description(const Shell& shell)
{
  const BS::Shell_report& report = shell.report();
  std::string text = shell.message();
  if(shell && report.refinement == BS::Refinement_status::LIMIT_REACHED) text += " " + message(report.limit);
  if(!report.obstacles.empty()) text += " " + message(report.obstacles.front(), report.unit, report.refinement);
  return QString::fromStdString(text);
}

QDoubleSpinBox* add_time_limit(QMultipleInputDialog& dialog)
{
  QDoubleSpinBox* limit = dialog.add<QDoubleSpinBox>("Time limit (seconds):");
  limit->setDecimals(0);
  limit->setRange(0, 1e6);
  limit->setSpecialValueText("none");
  limit->setValue(60);
  return limit;
}

double average_edge_length(const SMesh& mesh)
{
  double sum = 0;
  for(auto e : mesh.edges()) sum += CGAL::Polygon_mesh_processing::edge_length(mesh.halfedge(e), mesh);
  return sum / mesh.number_of_edges();
}

// Returns the points of a cloud, or the vertices of a mesh.
std::vector<Point_3> points_of(const Points_item& item)
{
  const auto points = item.point_set()->points();
  return { points.begin(), points.end() };
}
std::vector<Point_3> points_of(const Mesh_item& item)
{
  std::vector<Point_3> points;
  for(auto v : item.polyhedron()->vertices()) points.push_back(item.polyhedron()->point(v));
  return points;
}

// Returns a copy of the item with other points.
Points_item* copy_with_points(const Points_item& item, const std::vector<Point_3>& points)
{
  Points_item* copy = new Points_item(item);
  auto p = points.begin();
  for(auto n : *copy->point_set()) copy->point_set()->point(n) = *p++;
  return copy;
}
Mesh_item* copy_with_points(const Mesh_item& item, const std::vector<Point_3>& points)
{
  Mesh_item* copy = new Mesh_item(*item.polyhedron());
  auto p = points.begin();
  for(auto v : copy->polyhedron()->vertices()) copy->polyhedron()->point(v) = *p++;
  return copy;
}

} // namespace

void Bspline_shell_plugin::init(QMainWindow* window, CGAL::Three::Scene_interface* scene_interface, Messages_interface*)
{
  mw = window;
  scene = scene_interface;
  const auto add = [&](const char* name, const char* text, void (Bspline_shell_plugin::*slot)()) {
    QAction* action = new QAction(text, mw);
    action->setObjectName(name); // by which scripts trigger it
    action->setProperty("subMenuName", title);
    connect(action, &QAction::triggered, this, slot);
    m_actions << action;
    return action;
  };
  add("actionBuildShell", "Build Shell...", &Bspline_shell_plugin::ask_and_build_shell);
  add("actionSimplifyInShell", "Simplify in Shell...", &Bspline_shell_plugin::ask_and_simplify);
  add("actionRemeshInShell", "Remesh in Shell...", &Bspline_shell_plugin::ask_and_remesh);
  m_project = add("actionProjectInShell", "Project onto Mesh...", &Bspline_shell_plugin::ask_and_project);
  m_carry = add("actionCarryInShell", "Carry Colors and Properties...", &Bspline_shell_plugin::ask_and_carry);
}

bool Bspline_shell_plugin::applicable(QAction* action) const
{
  const int meshes = selected<Mesh_item>().size(), clouds = selected<Points_item>().size();
  if(action == m_carry) return meshes == 2;
  if(action == m_project) return meshes > 0 && meshes + clouds == 2;
  return meshes == 1;
}

template <typename Item>
QList<int> Bspline_shell_plugin::selected() const
{
  QList<int> numbers;
  for(int number : scene->selectionIndices())
    if(item_of<Item>(number)) numbers << number;
  std::sort(numbers.begin(), numbers.end()); // The order of `selectionIndices()` is unspecified.
  return numbers;
}

Mesh_item* Bspline_shell_plugin::add_mesh(SMesh mesh, const QString& name, const QColor& color)
{
  Mesh_item* item = new Mesh_item(std::move(mesh));
  item->setName(name);
  item->setColor(color);
  scene->addItem(item);
  return item;
}

// Returns a sentence about the places; empty if there are none.
QString Bspline_shell_plugin::add_places(const std::vector<Point_3>& places, const QString& name)
{
  if(places.empty()) return {};
  constexpr int pixels = 10;
  Points_item* item = new Points_item;
  for(const Point_3& place : places) item->point_set()->insert(place);
  item->setName(name);
  item->setColor(Qt::red);
  item->setPointSize(pixels);
  scene->addItem(item);
  return " Red points mark the places.";
}

QString Bspline_shell_plugin::build_shell(int number, double thickness, double time_limit)
{
  Mesh_item* item = item_of<Mesh_item>(number);
  if(!item) return without_mesh(number);
  const QString name = item->name();
  const SMesh& mesh = *item->polyhedron();
  Shell shell;
  SMesh inner, outer;
  const auto build = [&](Progress& progress) {
    shell = CGAL::certified_bspline_shell_3(
      mesh,
      parameters::relative_thickness(thickness / 100).time_limit(seconds(time_limit)).visitor(std::ref(progress)));
    if(!shell) return;
    BS::extract_shell_surface<CGAL::Parallel_if_available_tag>(shell, shell.inner_threshold(), inner);
    BS::extract_shell_surface<CGAL::Parallel_if_available_tag>(shell, shell.outer_threshold(), outer);
  };
  if(!run_with_dialog(mw, "Building a shell of " + name, build)) return canceled(name);
  const QString marks = add_places(places_of(shell.report(), mesh), "places without proof: " + name);
  if(!shell) return name + ": " + description(shell) + marks;

  set_shell(item, std::make_shared<const Shell>(shell));
  auto* group = new CGAL::Three::Scene_group_item(
    QString("%1 shell of %2").arg(shell.is_certified() ? "certified" : "uncertified", name));
  scene->addItem(group);
  const auto add_surface = [&](SMesh& surface, const char* surface_name, const QColor& color) {
    constexpr int alpha = 50; // The mesh is visible through the surfaces; 255 is opaque.
    if(surface.is_empty()) return Three::warning(QString("%1: the %2 could not be extracted.").arg(name, surface_name));
    Mesh_item* surface_item = add_mesh(std::move(surface), surface_name, color);
    surface_item->setRenderingMode(Flat);
    surface_item->setAlpha(alpha);
    scene->changeGroup(surface_item, group);
  };
  add_surface(inner, "inner surface", Qt::blue);
  add_surface(outer, "outer surface", Qt::red);
  scene->setSelectedItem(number);
  if(!shell.is_certified()) return name + ": " + description(shell) + marks;
  const BS::Shell_report& report = shell.report();
  QString text = QString("%1: the shell is certified. Its thickness is %2").arg(name).arg(shell.thickness());
  if(report.narrowed_area > 0)
    text += QString(", and less on %1 % of the area").arg(100 * report.narrowed_area, 0, 'g', 2);
  Three::information(
    QString("%1. (%2 cells, %3 s)").arg(text).arg(report.cells).arg(report.total_seconds(), 0, 'g', 2));
  return {};
}

template <typename Edit>
QString Bspline_shell_plugin::edit(int number, const char* edited, const Edit& edit)
{
  Mesh_item* item = item_of<Mesh_item>(number);
  if(!item) return without_mesh(number);
  const Shell_pointer shell = shell_of(item);
  if(!shell) return without_shell(item->name());
  SMesh mesh = *item->polyhedron();
  mesh.collect_garbage();
  BS::Edit_report report;
  if(!run_with_dialog(mw, "Editing " + item->name(), [&](Progress& p) { report = edit(mesh, *shell, p); }))
    return canceled(item->name());
  if(!report) {
    const QString marks = add_places(places_of(report, mesh), "rejected places: " + item->name());
    return item->name() + ": " + report.message().c_str() + marks;
  }
  mesh.collect_garbage();
  const QString result_name = QString("%1 %2 (%3 facets)").arg(edited, item->name()).arg(report.facets);
  Mesh_item* result = add_mesh(std::move(mesh), result_name, item->color());
  set_shell(result, shell);
  item->setVisible(false);
  scene->itemChanged(item);
  scene->setSelectedItem(scene->item_id(result));
  const bool is_at_target = report.end == BS::Edit_termination::STOP_PREDICATE
                            || report.end == BS::Edit_termination::TARGET;
  Three::information(QString("%1, instead of %2: the result is certified. %3")
                       .arg(result_name)
                       .arg(report.facets_before)
                       .arg(is_at_target ? "" : message(report.end)));
  return {};
}

QString Bspline_shell_plugin::simplify(int number, int facets, double time_limit)
{
  return edit(number, "simplified", [&](SMesh& mesh, const Shell& shell, Progress& progress) {
    return BS::simplify_in_shell(
      mesh, shell, parameters::stop(Facets_or_cancel_predicate(facets, progress)).time_limit(seconds(time_limit)));
  });
}

QString Bspline_shell_plugin::remesh(int number, double edge_length, double time_limit)
{
  return edit(number, "remeshed", [&](SMesh& mesh, const Shell& shell, Progress& progress) {
    return BS::remesh_in_shell(mesh, edge_length, shell,
                               parameters::time_limit(seconds(time_limit)).visitor(std::ref(progress)));
  });
}

template <typename Item>
QString Bspline_shell_plugin::project(const Item& item, const Mesh_item& target)
{
  const Shell_pointer shell = shell_of(&target) ? shell_of(&target) : shell_of(&item);
  if(!shell) return without_shell(target.name());
  std::vector<Point_3> points = points_of(item), missed;
  std::vector<BS::Projected_point<SMesh, Shell::Point_3> > images;
  if(!run_with_dialog(mw, "Projecting " + item.name(), [&](Progress& progress) {
       images = BS::project_points(*shell, points, *target.polyhedron(), parameters::visitor(std::ref(progress)));
     }))
    return canceled(item.name());
  BS::Flow_status reason = BS::Flow_status::SUCCESS;
  for(std::size_t n = 0; n < points.size(); ++n) {
    const auto& image = images[n];
    if(image) points[n] = Point_3(image.point.x(), image.point.y(), image.point.z());
    else {
      missed.push_back(points[n]);
      reason = image.status;
    }
  }
  Item* result = copy_with_points(item, points);
  result->setName("projected " + item.name());
  result->setColor(item.color());
  scene->addItem(result);
  const QString marks = add_places(missed, "no image: " + item.name());
  const QString count =
    QString("%1 of %2 points are on %3.").arg(points.size() - missed.size()).arg(points.size()).arg(target.name());
  if(!missed.empty())
    return QString("%1: %2 The others are not moved: %3").arg(item.name(), count, message(reason)) + marks;
  Three::information(item.name() + ": " + count);
  return {};
}

QString Bspline_shell_plugin::project(int from, int onto)
{
  const Mesh_item* target = item_of<Mesh_item>(onto);
  if(!target) return without_mesh(onto);
  if(const Points_item* points = item_of<Points_item>(from)) return project(*points, *target);
  if(const Mesh_item* mesh = item_of<Mesh_item>(from)) return project(*mesh, *target);
  return without_mesh(from);
}

QString Bspline_shell_plugin::carry(int from, int to)
{
  const Mesh_item* source = item_of<Mesh_item>(from);
  Mesh_item* target = item_of<Mesh_item>(to);
  if(!source || !target) return without_mesh(source ? to : from);
  const Shell_pointer shell = shell_of(source) ? shell_of(source) : shell_of(target);
  if(!shell) return without_shell(source->name());
  SMesh mesh = *target->polyhedron();
  Carried_properties carried;
  if(!run_with_dialog(
       mw, QString("Carrying properties from %1 to %2").arg(source->name(), target->name()),
       [&](Progress& progress) { carried = carry_properties(*shell, *source->polyhedron(), mesh, progress); }))
    return canceled(target->name());
  if(carried.names.empty()) return source->name() + " has neither colors, nor numbers at its vertices.";
  const auto& failures = carried.report.failures;
  if(carried.report.transferred == 0 && !failures.empty())
    return QString("%1: nothing was carried. %2").arg(target->name(), message(failures.front().second));

  // The item keeps handles of its property maps, so its mesh cannot be replaced.
  Mesh_item* result = new Mesh_item(std::move(mesh));
  result->setName(target->name());
  result->setColor(target->color());
  result->setRenderingMode(GouraudPlusEdges); // Flat modes do not show colors of vertices.
  set_shell(result, shell_of(target));
  scene->replaceItem(to, result, true);
  target->deleteLater();
  QStringList names;
  for(const std::string& name : carried.names) names << QString::fromStdString(name);
  const QString text = QString("%1: carried from %2: %3.").arg(result->name(), source->name(), names.join(", "));
  if(!failures.empty())
    return QString("%1 %2 vertices have no values: %3")
      .arg(text)
      .arg(failures.size())
      .arg(message(failures.front().second));
  Three::information(text);
  return {};
}

void Bspline_shell_plugin::show_failure(const QString& reason)
{
  if(reason.isEmpty()) return;
  Three::warning(reason);
  Three::warning(title, reason);
}

void Bspline_shell_plugin::ask_and_build_shell()
{
  QMultipleInputDialog dialog("Build Shell", mw);
  QDoubleSpinBox* thickness = dialog.add<QDoubleSpinBox>("Thickness (% of the longest side of the bounding box):");
  thickness->setDecimals(3);
  thickness->setRange(0.001, 50);
  thickness->setValue(1);
  QDoubleSpinBox* limit = add_time_limit(dialog);
  if(dialog.exec() == QDialog::Accepted)
    show_failure(build_shell(selected<Mesh_item>().first(), thickness->value(), limit->value()));
}

void Bspline_shell_plugin::ask_and_simplify()
{
  const int number = selected<Mesh_item>().first();
  const Mesh_item* item = item_of<Mesh_item>(number);
  if(!shell_of(item)) return show_failure(without_shell(item->name()));
  QMultipleInputDialog dialog("Simplify in Shell", mw);
  QSpinBox* facets = dialog.add<QSpinBox>("Number of facets:");
  facets->setRange(0, int(item->polyhedron()->number_of_faces()));
  facets->setSpecialValueText("as few as the shell permits");
  facets->selectAll(); // Otherwise, a typed number is appended to this text.
  QDoubleSpinBox* limit = add_time_limit(dialog);
  if(dialog.exec() == QDialog::Accepted) show_failure(simplify(number, facets->value(), limit->value()));
}

void Bspline_shell_plugin::ask_and_remesh()
{
  const int number = selected<Mesh_item>().first();
  const Mesh_item* item = item_of<Mesh_item>(number);
  if(!shell_of(item)) return show_failure(without_shell(item->name()));
  QMultipleInputDialog dialog("Remesh in Shell", mw);
  DoubleEdit* length = dialog.add<DoubleEdit>("Length of edges:");
  length->setValue(average_edge_length(*item->polyhedron()));
  QDoubleSpinBox* limit = add_time_limit(dialog);
  if(dialog.exec() == QDialog::Accepted) show_failure(remesh(number, length->value(), limit->value()));
}

bool Bspline_shell_plugin::ask_for_direction(const char* title, int& from, int& to)
{
  const QString one = scene->item(from)->name(), other = scene->item(to)->name();
  QMultipleInputDialog dialog(title, mw);
  QComboBox* direction = dialog.add<QComboBox>("Direction:");
  direction->addItem(QString("from %1 to %2").arg(one, other));
  direction->addItem(QString("from %1 to %2").arg(other, one));
  if(dialog.exec() != QDialog::Accepted) return false;
  if(direction->currentIndex() == 1) std::swap(from, to);
  return true;
}

void Bspline_shell_plugin::ask_and_project()
{
  const QList<int> meshes = selected<Mesh_item>(), clouds = selected<Points_item>();
  int from = clouds.isEmpty() ? meshes.first() : clouds.first(), onto = meshes.last();
  if(!clouds.isEmpty() || ask_for_direction("Project onto Mesh", from, onto)) show_failure(project(from, onto));
}

void Bspline_shell_plugin::ask_and_carry()
{
  int from = selected<Mesh_item>().first(), to = selected<Mesh_item>().last();
  if(ask_for_direction("Carry Colors and Properties", from, to)) show_failure(carry(from, to));
}

#include "Bspline_shell_plugin.moc"
