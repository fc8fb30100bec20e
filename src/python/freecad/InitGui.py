"""A workbench with the one command, for who puts this folder into FreeCAD's Mod folder."""

import FreeCADGui as Gui


class Look:
    """The command that shows the panel."""

    def GetResources(self):
        return {"MenuText": "Redundant constraints", "ToolTip": "True freedoms, joints that hold the same, other types"}

    def IsActive(self):
        return True

    def Activated(self):
        import ozols_panel

        ozols_panel.show()


class OzolsWorkbench(Gui.Workbench):
    """The workbench."""

    MenuText = "ozols"
    ToolTip = "Redundant constraints of assemblies"

    def Initialize(self):
        Gui.addCommand("Ozols_Look", Look())
        self.appendToolbar("ozols", ["Ozols_Look"])
        self.appendMenu("ozols", ["Ozols_Look"])

    def GetClassName(self):
        return "Gui::PythonWorkbench"


Gui.addWorkbench(OzolsWorkbench())
