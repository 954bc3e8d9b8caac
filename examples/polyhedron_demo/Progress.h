// The progress of a computation in another thread, and a dialog that shows and cancels it.
#ifndef POLYHEDRON_DEMO_PROGRESS_H
#define POLYHEDRON_DEMO_PROGRESS_H

#include <CGAL/Bspline_shell_3/Support/Progress.h>

#include <QApplication>
#include <QElapsedTimer>
#include <QProgressDialog>
#include <QString>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <future>

// A visitor of constructions of shells, of remeshing, and of projections. The thread of the computation calls it, and
// the thread of the dialog reads and cancels it.
class Progress
{
public:
  bool start_step(CGAL::Bspline_shells::Shell_step step)
  {
    m_step = name(step);
    return go_on();
  }
  bool start_iteration(unsigned int) { return go_on(); }
  bool go_on() const { return !m_is_canceled; }
  bool advance(std::size_t done, std::size_t total)
  {
    m_percentage = int(100 * done / total);
    return go_on();
  }

  void cancel() { m_is_canceled = true; }
  bool is_canceled() const { return m_is_canceled; }
  const char* step() const { return m_step; }
  int percentage() const { return m_percentage; }

private:
  std::atomic<bool> m_is_canceled{ false };
  std::atomic<const char*> m_step{ "" };
  std::atomic<int> m_percentage{ 0 }; // 0 if the length of the computation is unknown
};

// Calls `compute` with a `Progress` in another thread, while a dialog blocks the other windows of the demo. Returns
// whether the user let it end. What `compute` throws is thrown here.
template <typename Compute>
bool run_with_dialog(QWidget* window, const QString& title, const Compute& compute)
{
  Progress progress;
  QProgressDialog dialog(window);
  dialog.setWindowTitle("Cubic B-Spline Shell");
  dialog.setWindowModality(Qt::WindowModal);
  dialog.setAutoReset(false);
  dialog.setMinimumWidth(400);
  QElapsedTimer timer;
  timer.start();
  std::future<void> end = std::async(std::launch::async, [&] { compute(progress); });
  constexpr std::chrono::milliseconds between_updates(50); // short enough for animations
  while(end.wait_for(between_updates) != std::future_status::ready) {
    dialog.show(); // also after a click on "Cancel", until the computation notices it
    if(dialog.wasCanceled()) progress.cancel();
    dialog.setLabelText(QString("%1 ... %2 s\n%3")
                          .arg(title)
                          .arg(timer.elapsed() / 1000)
                          .arg(progress.is_canceled() ? "canceling" : progress.step()));
    dialog.setMaximum(progress.percentage() > 0 ? 100 : 0);
    dialog.setValue(progress.percentage());
    QApplication::processEvents();
  }
  end.get();
  return !progress.is_canceled();
}

#endif // POLYHEDRON_DEMO_PROGRESS_H
