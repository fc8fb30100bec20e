"""A panel of FreeCAD: checks the open document, lists its redundant constraints, applies the cheapest change of joint types."""

import FreeCAD as App
import FreeCADGui as Gui
from ozols import freecad as ozols
from PySide import QtCore, QtGui

NAME = "OzolsPanel"


class Panel(QtGui.QDockWidget):
    """The panel; ``found`` is what was found last."""

    def __init__(self, parent=None):
        super().__init__("Redundant constraints", parent)
        self.setObjectName(NAME)
        self.found = None
        inner = QtGui.QWidget()
        rows = QtGui.QVBoxLayout(inner)
        look = QtGui.QPushButton("Look at the open document")
        look.clicked.connect(self.look)
        self.text = QtGui.QPlainTextEdit()
        self.text.setReadOnly(True)
        self.take = QtGui.QPushButton("Take the change of joint types")
        self.take.clicked.connect(self.change)
        self.take.setEnabled(False)
        for widget in (look, self.text, self.take):
            rows.addWidget(widget)
        self.setWidget(inner)

    def look(self):
        """Shows what is found in the document as it is now."""
        self.found = None
        try:
            if App.ActiveDocument is None:
                raise ozols.Error("no document is open")
            self.found = ozols.check(App.ActiveDocument)
            self.text.setPlainText(self.found.text)
        except ozols.Error as e:
            self.text.setPlainText(str(e))
        self.take.setEnabled(bool(self.found and self.found.changes))

    def change(self):
        """Takes the change, and looks again."""
        try:
            ozols.take(App.ActiveDocument, self.found.changes)
        except ozols.Error as e:
            self.text.setPlainText(str(e))
            return
        self.look()


def show():
    """Shows the panel, and looks at the document at once."""
    main = Gui.getMainWindow()
    panel = main.findChild(QtGui.QDockWidget, NAME)
    if panel is None:
        panel = Panel(main)
        main.addDockWidget(QtCore.Qt.RightDockWidgetArea, panel)
    panel.show()
    panel.look()
