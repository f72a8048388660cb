def specs(folder):
    t = {"tables": {"csv": {}}}
    return {"sweep": t, "work_precision": t, "hazards": t}
def spec_of(figure, scene, specs):
    return {"notebook": scene["notebook"], "tables": {"csv": {}}}
